// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/reentrant_corners.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>
#include <deal.II/physics/vector_relations.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace perideal
{
  namespace
  {
    constexpr double smallest_angle = 7. / 6. * dealii::numbers::PI;

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
  } // namespace

  template <int dim>
  std::vector<ReentrantCorner<dim>> reentrant_corners(const Mesh<dim> &mesh)
  {
    const auto         &coarse = mesh.triangulation;
    std::set<Ends<dim>> outer;
    for (const auto &cell : coarse.cell_iterators_on_level(0))
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && mesh.cylinders.count(face->boundary_id()) == 0)
          {
            if constexpr (dim == 2)
              for (const unsigned int v : face->vertex_indices())
                outer.insert({face->vertex_index(v)});
            else
              for (unsigned int l = 0; l < face->n_lines(); ++l)
                outer.insert(in_order<dim>(face->line(l)->vertex_index(0), face->line(l)->vertex_index(1)));
          }
    std::map<Ends<dim>, double> angle_of;
    for (const auto &cell : coarse.cell_iterators_on_level(0))
      visit_corners<dim>(cell, [&](const Ends<dim> &ends, const double angle) {
        if (outer.count(ends) > 0)
          angle_of[ends] += angle;
      });
    std::vector<ReentrantCorner<dim>> result;
    for (const auto &[ends, angle] : angle_of)
      if (angle >= smallest_angle)
        {
          ReentrantCorner<dim> corner{{}, std::min(angle, 2. * dealii::numbers::PI)};
          for (unsigned int k = 0; k < ends.size(); ++k)
            corner.ends[k] = coarse.get_vertices()[ends[k]];
          result.push_back(corner);
        }
    return result;
  }

  double singular_exponent(const double angle)
  {
    Assert(angle >= dealii::numbers::PI && angle <= 2. * dealii::numbers::PI, dealii::ExcInternalError());
    const auto     function = [angle](const double q) { return std::sin(q * angle) + q * std::sin(angle); };
    constexpr auto crack = 0.5, smooth = 1.;
    // At the ends of the interval rounding decides about signs.
    if (function(crack) <= 0.)
      return 1. - crack;
    if (function(smooth) >= 0.)
      return 1. - smooth;
    const auto [low, high] =
      boost::math::tools::bisect(function, crack, smooth, boost::math::tools::eps_tolerance<double>(40));
    return 1. - 0.5 * (low + high);
  }

  template std::vector<ReentrantCorner<2>> reentrant_corners(const Mesh<2> &);
  template std::vector<ReentrantCorner<3>> reentrant_corners(const Mesh<3> &);
} // namespace perideal
