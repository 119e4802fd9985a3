// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/reentrant_corners.h>
#include <perideal/problem/strain_at_corners.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/boost_adaptors/segment.h>
#include <deal.II/numerics/rtree.h>

#include <cmath>
#include <utility>

namespace perideal
{
  template <int dim>
  std::vector<double> singular_exponents(const Body<dim> &body)
  {
    namespace bgi                              = boost::geometry::index;
    using Edge                                 = boost::geometry::model::segment<dealii::Point<dim>>;
    const Nodes<dim>                    &nodes = *body.nodes;
    std::vector<double>                  result(nodes.size(), 0.);
    std::vector<std::pair<Edge, double>> corners;
    for (const auto &corner : reentrant_corners(*body.mesh))
      corners.emplace_back(Edge(corner.ends.front(), corner.ends.back()), singular_exponent(corner.angle));
    const auto all = dealii::pack_rtree(corners);
    for (LocalIndex i = 0; i < nodes.size() && !corners.empty(); ++i)
      if (const auto nearest = all.qbegin(bgi::nearest(nodes.position[i], 1));
          boost::geometry::distance(nodes.position[i], nearest->first) < nodes.horizon[i])
        result[i] = nearest->second;
    return result;
  }

  template <int dim>
  std::vector<double> utilisation_in_smallest_cells(const Problem<dim>        &problem,
                                                    const std::vector<double> &exponents)
  {
    std::vector<double> result = problem.force->utilisation();
    AssertDimension(exponents.size(), result.size());
    for (LocalIndex i = 0; i < result.size(); ++i)
      result[i] *= std::pow(problem.body.nodes->finest_share(i), -exponents[i]);
    return result;
  }

  PERIDEAL_INSTANTIATE(singular_exponents)
  PERIDEAL_INSTANTIATE(utilisation_in_smallest_cells)
} // namespace perideal
