// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/mesh_checks.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <map>
#include <sstream>

namespace perideal
{
  template <int dim>
  std::string in_words(const CoarseMesh<dim> &mesh, const CoarseCell<dim> &cell)
  {
    std::ostringstream text;
    if (mesh.element_numbers.empty())
      text << "cell " << cell->index();
    else
      text << "element " << mesh.element_numbers[cell->index()];
    text << " about (" << cell->center() << ")";
    return text.str();
  }

  template <int dim>
  InputError mesh_error(const CoarseMesh<dim> &mesh, const std::string &problem)
  {
    return InputError(problem)
      .location(mesh.origin)
      .parameter(mesh.element_numbers.empty() ? "Mesh/Generator" : "Mesh/File");
  }

  template <int dim>
  dealii::Tensor<1, dim> face_normal(const CoarseCell<dim> &cell, const unsigned int f)
  {
    const auto face = cell->face(f);
    if constexpr (dim == 2)
      return cross_product_2d(face->vertex(1) - face->vertex(0));
    else
      return cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
  }

  namespace
  {
    template <int dim>
    using Cell = CoarseCell<dim>;

    /// Determinant of unit edge vectors below which a corner counts as flat:
    /// files of six digits leave as much to a corner that is meant to be flat.
    constexpr double flat_corner = 1e-6;

    /// Two points closer than this share of the cell's size coincide.
    constexpr double coincident = 1e-12;

    template <int dim>
    using Corners = std::array<dealii::Point<dim>, dealii::GeometryInfo<dim>::vertices_per_cell>;

    /// Determinant of the edges that leave a corner, each of unit length, in
    /// the order of the cell's coordinate directions. No edge has zero length.
    template <int dim>
    double scaled_jacobian(const Corners<dim> &x, const unsigned int corner)
    {
      dealii::Tensor<2, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        {
          // vertices are numbered lexicographically: bit d is the coordinate
          const unsigned int           bit  = 1u << d;
          const dealii::Tensor<1, dim> edge = x[corner | bit] - x[corner & ~bit];
          edges[d]                          = edge / edge.norm();
        }
      return determinant(edges);
    }

    /// What is wrong with the shape of a cell, or an empty string.
    template <int dim>
    std::string shape_defect(const Cell<dim> &cell)
    {
      Corners<dim> x;
      double       size_square = 0;
      for (const unsigned int v : cell->vertex_indices())
        {
          x[v]        = cell->vertex(v);
          size_square = std::max(size_square, x[v].distance_square(x[0]));
        }
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int w = 0; w < v; ++w)
          if (!(x[v].distance_square(x[w]) > coincident * coincident * size_square))
            {
              std::ostringstream text;
              text << "is collapsed: two of its corners coincide at (" << x[v] << ")";
              return text.str();
            }

      unsigned int n_flat = 0;
      std::string  corners;
      for (const unsigned int v : cell->vertex_indices())
        {
          const double jacobian = scaled_jacobian<dim>(x, v);
          if (jacobian > flat_corner)
            continue;
          n_flat += jacobian >= -flat_corner ? 1 : 0;
          std::ostringstream text;
          text << (corners.empty() ? "(" : ", (") << x[v] << ")";
          corners += text.str();
        }
      if (corners.empty())
        return "";
      if (n_flat == x.size())
        return dim == 2 ? "is flat: it has no area" : "is flat: it has no volume";
      return "is folded over, inverted or not convex: its Jacobian is not positive at " + corners;
    }

    template <int dim>
    void check_shapes(const CoarseMesh<dim> &mesh)
    {
      unsigned int n_bad = 0;
      std::string  first;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        {
          const std::string defect = shape_defect<dim>(cell);
          if (!defect.empty() && n_bad++ == 0)
            first = in_words<dim>(mesh, cell) + " " + defect;
        }
      if (n_bad > 1)
        first += " (and " + std::to_string(n_bad - 1) + " more)";
      if (n_bad > 0)
        throw mesh_error(mesh, first)
          .hint(mesh.element_numbers.empty() ?
                  "choose other sizes of the generator, or a smaller Mesh/Distortion" :
                  "subdivision (Mesh.SubdivisionAlgorithm) folds cells where it moves their new corners to "
                  "curved boundaries: leave these on straight edges (Mesh.SecondOrderLinear = 1), choose "
                  "smaller sizes there (Mesh.MeshSizeFromCurvature = 24 cells a turn; Mesh.MeshSizeMax), or "
                  "extrude or use transfinite surfaces and volumes instead. Gmsh shows the element (Tools, "
                  "Visibility)");
    }

    /// Two cells at a face must be each other's only neighbours there, on either
    /// side of it. deal.II takes a third cell at a face in silence.
    template <int dim>
    void check_neighbours(const CoarseMesh<dim> &mesh)
    {
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        for (const unsigned int f : cell->face_indices())
          if (!cell->at_boundary(f))
            {
              const auto neighbour = cell->neighbor(f);
              bool       is_mutual = false;
              for (const unsigned int g : neighbour->face_indices())
                is_mutual = is_mutual || (neighbour->face(g) == cell->face(f) &&
                                          neighbour->neighbor_index(g) == cell->index());
              const dealii::Tensor<1, dim> normal = face_normal<dim>(cell, f);
              const dealii::Point<dim>     centre = cell->face(f)->center();
              const bool                   opposite =
                (normal * (cell->center() - centre)) * (normal * (neighbour->center() - centre)) < 0;
              if (!is_mutual || !opposite)
                throw mesh_error(mesh,
                                 in_words<dim>(mesh, cell) + " and " + in_words<dim>(mesh, neighbour) +
                                   " lie on one another: a face separates two cells at most")
                  .hint("is a surface (in 3-D a volume) in two physical groups, or drawn twice? "
                        "Coherence; in the .geo file unites duplicates");
            }
    }

    /// Every face that the file puts into a boundary group must have arrived;
    /// deal.II drops those that are no side of a cell, or are in two groups.
    template <int dim>
    void check_boundary_groups(const CoarseMesh<dim> &mesh)
    {
      std::map<dealii::types::boundary_id, std::uint64_t> n_faces;
      for (const auto &face : mesh.triangulation.active_face_iterators())
        if (face->at_boundary())
          ++n_faces[face->boundary_id()];
      for (const auto &group : mesh.faces_in_file)
        if (n_faces[group.first] != group.second)
          {
            std::string name = std::to_string(group.first);
            for (const auto &named : mesh.boundary_names)
              if (named.second == group.first)
                name = named.first;
            throw mesh_error(mesh,
                             "the boundary group " + name + " has " + std::to_string(group.second) +
                               " faces in the file, of which " + std::to_string(n_faces[group.first]) +
                               " are sides of cells on the surface and in no other group")
              .hint("put every boundary curve (in 3-D surface) into one physical group, and only those that "
                    "bound the body");
          }
    }
  } // namespace

  template <int dim>
  void check_coarse_mesh(const CoarseMesh<dim> &mesh)
  {
    Assert(mesh.triangulation.all_reference_cells_are_hyper_cube(),
           dealii::ExcMessage("readers and generators make quadrilaterals and hexahedra"));
    check_shapes(mesh);
    check_neighbours(mesh);
    check_joints(mesh);
    check_boundary_groups(mesh);
  }

  template <int dim>
  void check_refined_mesh(const dealii::Triangulation<dim> &triangulation, const std::string &origin)
  {
    std::string first;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && first.empty())
        {
          const std::string defect = shape_defect<dim>(cell);
          if (defect.empty())
            continue;
          std::ostringstream text;
          text << "after refinement the cell about (" << cell->center() << ") " << defect;
          first = text.str();
        }
    const MPI_Comm communicator = triangulation.get_communicator();
    for (const std::string &found : dealii::Utilities::MPI::all_gather(communicator, first))
      if (!found.empty())
        throw InputError(found)
          .location(origin)
          .parameter("Mesh/Refinements")
          .hint("make the coarse mesh finer along its curved boundaries, and refine less");
  }

  template std::string          in_words(const CoarseMesh<2> &, const CoarseCell<2> &);
  template std::string          in_words(const CoarseMesh<3> &, const CoarseCell<3> &);
  template InputError           mesh_error(const CoarseMesh<2> &, const std::string &);
  template InputError           mesh_error(const CoarseMesh<3> &, const std::string &);
  template dealii::Tensor<1, 2> face_normal<2>(const CoarseCell<2> &, const unsigned int);
  template dealii::Tensor<1, 3> face_normal<3>(const CoarseCell<3> &, const unsigned int);
  PERIDEAL_INSTANTIATE(check_refined_mesh)
  PERIDEAL_INSTANTIATE(check_coarse_mesh)
} // namespace perideal
