// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/singular_exponents.h>
#include <perideal/mesh/boundary_corners.h>
#include <perideal/problem/bond_limits.h>
#include <perideal/problem/strain_at_corners.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>
#include <deal.II/boost_adaptors/segment.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace perideal
{
  namespace
  {
    /// How a side of a corner is held.
    enum class Hold
    {
      /// As its mirror image would: along its normal alone.
      mirror,
      clamped,
      free
    };

    template <int dim>
    Hold hold_of(const typename BoundaryCorner<dim>::Side &side, const Loads<dim> &loads)
    {
      constexpr double      nearly = 1. - 1e-3;
      std::array<bool, dim> held{};
      for (const BoundaryCondition<dim> &condition : loads.conditions)
        if (condition.acts_on(side.boundary))
          for (int d = 0; d < dim; ++d)
            held[d] = held[d] || condition.holds(d);
      const auto n_held = std::count(held.begin(), held.end(), true);
      if (n_held == 0)
        return Hold::free;
      for (int d = 0; d < dim; ++d)
        if (n_held == 1 && held[d] && std::abs(side.normal[d]) > nearly)
          return Hold::mirror;
      return Hold::clamped;
    }

    template <int dim>
    double exponent_of(const BoundaryCorner<dim> &corner, const Problem<dim> &problem)
    {
      const Loads<dim> &loads = problem.loading.loads;
      const Hold one = hold_of<dim>(corner.sides[0], loads), other = hold_of<dim>(corner.sides[1], loads);
      if ((one == Hold::free) == (other == Hold::free))
        return corner.is_reentrant() ? exponent_of_free_corner(corner.angle) : 0.;
      if (one == Hold::mirror || other == Hold::mirror)
        return exponent_of_free_corner(std::min(2. * corner.angle, 2. * dealii::numbers::PI));
      const ElasticConstants solid   = problem.body.solids.at(corner.material).isotropic();
      const double           nu      = solid.poisson_ratio;
      const bool             is_thin = solid.assumption == PlaneAssumption::plane_stress;
      return exponent_of_clamped_corner(corner.angle, is_thin ? (3. - nu) / (1. + nu) : 3. - 4. * nu);
    }
  } // namespace

  template <int dim>
  std::vector<double> singular_exponents(const Problem<dim> &problem)
  {
    namespace bgi                              = boost::geometry::index;
    using Edge                                 = boost::geometry::model::segment<dealii::Point<dim>>;
    const Nodes<dim>                    &nodes = *problem.body.nodes;
    std::vector<double>                  result(nodes.size(), 0.);
    std::vector<std::pair<Edge, double>> corners;
    for (const BoundaryCorner<dim> &corner : boundary_corners(*problem.body.mesh))
      if (const double exponent = exponent_of(corner, problem); exponent > 0)
        corners.emplace_back(Edge(corner.ends.front(), corner.ends.back()), exponent);
    const auto all = dealii::pack_rtree(corners);
    for (LocalIndex i = 0; i < nodes.size() && !corners.empty(); ++i)
      if (const auto nearest = all.qbegin(bgi::nearest(nodes.position[i], 1));
          boost::geometry::distance(nodes.position[i], nearest->first) < nodes.horizon[i] &&
          !softens_from_strength(problem.body, nodes.material[i]))
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
