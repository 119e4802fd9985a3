// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/mesh_checks.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

namespace perideal
{
  namespace
  {
    /// Finds points near a point: a lattice of cubes of the given width.
    template <int dim>
    class Lattice
    {
    public:
      explicit Lattice(const double width)
        : width(width)
      {
      }

      void add(const dealii::Point<dim> &point, const unsigned int index)
      {
        cubes[cube_of(point)].push_back(index);
      }

      /// Calls @p action with the index of every point that is nearer than the width, and of some others.
      template <typename Action>
      void for_each_near(const dealii::Point<dim> &point, const Action &action) const
      {
        const Cube centre = cube_of(point);
        for (unsigned int k = 0; k < (dim == 2 ? 9u : 27u); ++k)
          {
            Cube cube = centre;
            for (unsigned int d = 0, rest = k; d < dim; ++d, rest /= 3)
              cube[d] += static_cast<double>(rest % 3) - 1.;
            const auto found = cubes.find(cube);
            if (found != cubes.end())
              for (const unsigned int index : found->second)
                action(index);
          }
      }

    private:
      using Cube = std::array<double, dim>;

      Cube cube_of(const dealii::Point<dim> &point) const
      {
        Cube cube;
        for (unsigned int d = 0; d < dim; ++d)
          cube[d] = std::floor(point[d] / width);
        return cube;
      }

      const double                              width;
      std::map<Cube, std::vector<unsigned int>> cubes;
    };

    const std::string unite_the_parts =
      "Coherence; or BooleanFragments before meshing makes parts share their boundaries (bodies of "
      "OpenCASCADE do not "
      "by themselves); Geometry.AutoCoherence = 1; does so for points drawn twice, and Coherence Mesh; "
      "unites doubled "
      "nodes. For a crack, give Precracks or a physical group inside the body";

    /// Two vertices at one place separate what looks like one body.
    template <int dim>
    void check_doubled_vertices(const CoarseMesh<dim> &mesh)
    {
      // the shortest face at each vertex of the surface
      std::map<unsigned int, double> sizes;
      double                         largest = 0;
      for (const auto &face : mesh.triangulation.active_face_iterators())
        if (face->at_boundary())
          for (const unsigned int v : face->vertex_indices())
            {
              const double size = face->diameter();
              const auto   here = sizes.emplace(face->vertex_index(v), size).first;
              here->second      = std::min(here->second, size);
              largest           = std::max(largest, size);
            }
      constexpr double   tolerance = 1e-6;
      const auto        &vertices  = mesh.triangulation.get_vertices();
      Lattice<dim>       lattice(tolerance * largest);
      unsigned int       n_doubled = 0;
      dealii::Point<dim> first;
      for (const auto &here : sizes)
        {
          const dealii::Point<dim> &place      = vertices[here.first];
          bool                      is_doubled = false;
          lattice.for_each_near(place, [&](const unsigned int other) {
            is_doubled = is_doubled ||
                         place.distance(vertices[other]) < tolerance * std::min(here.second, sizes.at(other));
          });
          if (is_doubled && n_doubled++ == 0)
            first = place;
          lattice.add(place, here.first);
        }
      if (n_doubled == 0)
        return;
      std::ostringstream text;
      text << "the mesh has " << n_doubled << (n_doubled == 1 ? " doubled node" : " doubled nodes")
           << ": two nodes at one place, the first at (" << first
           << "), so that its parts are not joined there";
      throw mesh_error(mesh, text.str()).hint(unite_the_parts);
    }

    /// The part of the mesh that each cell is in; faces join cells to a part.
    template <int dim>
    std::vector<unsigned int> parts_of(const dealii::Triangulation<dim> &triangulation, unsigned int &n_parts)
    {
      std::vector<unsigned int> part(triangulation.n_active_cells(), dealii::numbers::invalid_unsigned_int);
      n_parts = 0;
      for (const auto &start : triangulation.active_cell_iterators())
        if (part[start->index()] == dealii::numbers::invalid_unsigned_int)
          {
            std::vector<CoarseCell<dim>> todo = {start};
            part[start->index()]              = n_parts;
            while (!todo.empty())
              {
                const CoarseCell<dim> cell = todo.back();
                todo.pop_back();
                for (const unsigned int f : cell->face_indices())
                  if (!cell->at_boundary(f) &&
                      part[cell->neighbor(f)->index()] == dealii::numbers::invalid_unsigned_int)
                    {
                      part[cell->neighbor(f)->index()] = n_parts;
                      todo.push_back(cell->neighbor(f));
                    }
              }
            ++n_parts;
          }
      return part;
    }

    /// Whether a point lies inside a convex cell.
    template <int dim>
    bool is_inside(const CoarseCell<dim> &cell, const dealii::Point<dim> &point)
    {
      bool inside = true;
      for (const unsigned int f : cell->face_indices())
        {
          const dealii::Tensor<1, dim> normal = face_normal<dim>(cell, f);
          const dealii::Point<dim>     centre = cell->face(f)->center();
          inside = inside && (normal * (point - centre)) * (normal * (cell->center() - centre)) > 0;
        }
      return inside;
    }

    /// Parts that no face joins must not lie in one another.
    template <int dim>
    void check_overlaps(const CoarseMesh<dim> &mesh)
    {
      unsigned int                    n_parts = 0;
      const std::vector<unsigned int> part    = parts_of(mesh.triangulation, n_parts);
      if (n_parts == 1)
        return;
      std::vector<dealii::BoundingBox<dim>> boxes(n_parts);
      std::vector<bool>                     has_box(n_parts, false);
      std::vector<CoarseCell<dim>>          cells;
      double                                largest = 0;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        {
          const unsigned int here = part[cell->index()];
          has_box[here] ? boxes[here].merge_with(cell->bounding_box()) :
                          void(boxes[here] = cell->bounding_box());
          has_box[here] = true;
          largest       = std::max(largest, cell->diameter());
          cells.push_back(cell);
        }
      const auto touches_another_box = [&](const CoarseCell<dim> &cell) {
        for (unsigned int other = 0; other < n_parts; ++other)
          if (other != part[cell->index()] && boxes[other].point_inside(cell->center()))
            return true;
        return false;
      };
      Lattice<dim> lattice(largest);
      for (std::size_t k = 0; k < cells.size(); ++k)
        lattice.add(cells[k]->center(), k);
      unsigned int n_overlaps = 0;
      std::string  first;
      for (const CoarseCell<dim> &cell : cells)
        if (touches_another_box(cell))
          {
            bool overlaps = false;
            lattice.for_each_near(cell->center(), [&](const unsigned int k) {
              if (!overlaps && part[cells[k]->index()] != part[cell->index()] &&
                  is_inside<dim>(cells[k], cell->center()))
                {
                  overlaps = true;
                  if (n_overlaps == 0)
                    first = in_words<dim>(mesh, cell) + " lies in " + in_words<dim>(mesh, cells[k]);
                }
            });
            n_overlaps += overlaps ? 1 : 0;
          }
      if (n_overlaps > 0)
        throw mesh_error(mesh,
                         "parts of the mesh lie on one another without being joined: " + first + " (" +
                           std::to_string(n_overlaps) + " cells in all)")
          .hint(unite_the_parts);
    }
  } // namespace

  template <int dim>
  void check_joints(const CoarseMesh<dim> &mesh)
  {
    check_doubled_vertices(mesh);
    check_overlaps(mesh);
  }

  PERIDEAL_INSTANTIATE(check_joints)
} // namespace perideal
