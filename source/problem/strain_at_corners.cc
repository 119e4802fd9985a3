// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/reentrant_corners.h>
#include <perideal/problem/strain_at_corners.h>

#include <deal.II/boost_adaptors/segment.h>
#include <deal.II/numerics/rtree.h>

#include <cmath>
#include <utility>

namespace perideal
{
  template <int dim>
  std::vector<double> utilisation_in_smallest_cells(const Problem<dim> &problem)
  {
    namespace bgi                               = boost::geometry::index;
    using Edge                                  = boost::geometry::model::segment<dealii::Point<dim>>;
    const Nodes<dim>                    &nodes  = *problem.body.nodes;
    std::vector<double>                  result = problem.force->utilisation();
    std::vector<std::pair<Edge, double>> corners;
    for (const auto &corner : reentrant_corners(*problem.body.mesh))
      corners.emplace_back(Edge(corner.ends.front(), corner.ends.back()), singular_exponent(corner.angle));
    const auto all = dealii::pack_rtree(corners);
    for (LocalIndex i = 0; i < nodes.size() && !corners.empty(); ++i)
      if (nodes.finest_share(i) < 1. && result[i] > 0)
        {
          const auto nearest = all.qbegin(bgi::nearest(nodes.position[i], 1));
          if (boost::geometry::distance(nodes.position[i], nearest->first) < nodes.horizon[i])
            result[i] *= std::pow(nodes.finest_share(i), -nearest->second);
        }
    return result;
  }

  PERIDEAL_INSTANTIATE(utilisation_in_smallest_cells)
} // namespace perideal
