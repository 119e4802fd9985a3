// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/boundary_corners.h>

#include <deal.II/physics/vector_relations.h>

#include <algorithm>
#include <map>
#include <vector>

namespace perideal
{
  namespace
  {
    template <int dim>
    using Ends = std::array<unsigned int, dim - 1>;

    /// The vertices of a corner in ascending order.
    template <int dim>
    Ends<dim> in_order(const unsigned int v, const unsigned int w)
    {
      Ends<dim> result{};
      result.front() = std::min(v, w);
      result.back()  = std::max(v, w);
      return result;
    }

    /// Calls visit(ends, angle) with the corners of a cell.
    template <int dim, typename Visit>
    void visit_corners(const typename dealii::Triangulation<dim>::cell_iterator &cell, const Visit &visit)
    {
      // From a vertex, along the axes of the cell, others are those with one more or less bit.
      for (const unsigned int v : cell->vertex_indices())
        for (unsigned int along = 0; along < (dim == 2 ? 1 : dim); ++along)
          {
            const unsigned int w = dim == 2 ? v : v ^ (1u << along);
            if (w < v)
              continue;
            const auto                          middle = 0.5 * (cell->vertex(v) + cell->vertex(w));
            std::vector<dealii::Tensor<1, dim>> sides;
            for (unsigned int axis = 0; axis < dim; ++axis)
              if (dim == 2 || axis != along)
                sides.push_back(0.5 * (cell->vertex(v ^ (1u << axis)) + cell->vertex(w ^ (1u << axis))) -
                                middle);
            if (dim == 3)
              {
                const dealii::Tensor<1, dim> edge      = cell->vertex(w) - cell->vertex(v);
                const dealii::Tensor<1, dim> direction = edge / edge.norm();
                for (dealii::Tensor<1, dim> &side : sides)
                  side -= (side * direction) * direction;
              }
            visit(in_order<dim>(cell->vertex_index(v), cell->vertex_index(w)),
                  dealii::Physics::VectorRelations::angle(sides[0], sides[1]));
          }
    }

    /// Calls visit(ends) with those of a face.
    template <int dim, typename Face, typename Visit>
    void visit_corners_of_face(const Face &face, const Visit &visit)
    {
      if constexpr (dim == 2)
        for (const unsigned int v : face->vertex_indices())
          visit(Ends<dim>{face->vertex_index(v)});
      else
        for (unsigned int l = 0; l < face->n_lines(); ++l)
          visit(in_order<dim>(face->line(l)->vertex_index(0), face->line(l)->vertex_index(1)));
    }

    template <int dim>
    dealii::Tensor<1, dim> outward_normal(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                                          const unsigned int                                        f)
    {
      const auto             face = cell->face(f);
      dealii::Tensor<1, dim> result;
      if constexpr (dim == 2)
        result = dealii::cross_product_2d(face->vertex(1) - face->vertex(0));
      else
        result =
          dealii::cross_product_3d(face->vertex(3) - face->vertex(0), face->vertex(2) - face->vertex(1));
      result /= result.norm();
      return result * (face->center() - cell->center()) < 0 ? -result : result;
    }
  } // namespace

  template <int dim>
  std::vector<BoundaryCorner<dim>> boundary_corners(const Mesh<dim> &mesh)
  {
    using Side         = typename BoundaryCorner<dim>::Side;
    const auto &coarse = mesh.triangulation;

    std::map<Ends<dim>, std::vector<Side>> sides_of;
    for (const auto &cell : coarse.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          visit_corners_of_face<dim>(cell->face(f), [&](const Ends<dim> &ends) {
            sides_of[ends].push_back({cell->face(f)->boundary_id(), outward_normal<dim>(cell, f)});
          });

    const auto is_curved = [&](const Side &side) { return mesh.cylinders.count(side.boundary) > 0; };
    std::map<Ends<dim>, BoundaryCorner<dim>> corners;
    for (const auto &[ends, sides] : sides_of)
      if (sides.size() == 2 && !(is_curved(sides[0]) && is_curved(sides[1])))
        {
          BoundaryCorner<dim> &corner = corners[ends];
          corner.angle                = 0.;
          corner.sides                = {{sides[0], sides[1]}};
          for (unsigned int k = 0; k < ends.size(); ++k)
            corner.ends[k] = coarse.get_vertices()[ends[k]];
        }
    for (const auto &cell : coarse.cell_iterators_on_level(0))
      visit_corners<dim>(cell, [&](const Ends<dim> &ends, const double angle) {
        if (const auto corner = corners.find(ends); corner != corners.end())
          {
            corner->second.angle += angle;
            corner->second.material = cell->material_id();
          }
      });
    std::vector<BoundaryCorner<dim>> result;
    for (const auto &entry : corners)
      if (const BoundaryCorner<dim> &corner = entry.second;
          corner.is_reentrant() || corner.sides[0].boundary != corner.sides[1].boundary)
        result.push_back(corner);
    return result;
  }

  template std::vector<BoundaryCorner<2>> boundary_corners(const Mesh<2> &);
  template std::vector<BoundaryCorner<3>> boundary_corners(const Mesh<3> &);
} // namespace perideal
