// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/continuum_force.h>
#include <perideal/operators/force/intact_gradients.h>
#include <perideal/operators/post/partial_stress.h>
#include <perideal/operators/weights/cell_points.h>
#include <perideal/problem/crack_driving.h>
#include <perideal/problem/elastic_states.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Inner over outer radius of a ring. Cells within a horizon of the tip have no gradient to speak of.
    constexpr double inner_share = 1. / 3.;

    /// How far a ring keeps away from what is in its way, in horizons: q is nearly 0 at its rim.
    constexpr double margin = 0.5;

    /// How far off its line, over the distance from the tip, a crack counts as straight [-].
    constexpr double straight = 0.05;

    template <int dim>
    double distance_to_surface(const Problem<dim> &problem, const dealii::Point<dim> &point)
    {
      double result = std::numeric_limits<double>::max();
      for (const BoundaryFace<dim> &face : problem.body.faces)
        result = std::min(result,
                          dim == 2 ? Facet<dim>(face.vertices).distance(point) : face.centre.distance(point));
      return dealii::Utilities::MPI::min(result, problem.run.communicator);
    }

    template <int dim>
    std::vector<CrackEnd<dim>> all_ends(const Problem<dim> &problem)
    {
      std::vector<CrackEnd<dim>> result;
      for (std::size_t k = 0; k < problem.failure.precracks.size(); ++k)
        for (const CrackEnd<dim> &end : ends_of(problem.failure.precracks[k].parts(), k))
          result.push_back(end);
      return result;
    }

    /// Whether an end lies in the body: outside of it there is no node so near, on its surface a face.
    /// Collective.
    template <int dim>
    bool is_inside(const Problem<dim> &problem, const CrackEnd<dim> &end)
    {
      const dealii::Point<dim> middle = end.middle();
      const NearestNode        node   = nearest_node(problem, middle);
      // In 3-D from the middle of a face to the far end of it.
      const double off = 0.5 * (dim == 2 ? 1. : 1.8) * node.spacing;
      return node.distance < 1.5 * node.spacing && distance_to_surface(problem, middle) > off;
    }

    /// Whether a part of a crack is behind a tip on its line, as far as cells tell.
    bool is_behind(const PlaneTip &tip, const Facet<2> &part, const double spacing)
    {
      return std::all_of(part.corners().begin(), part.corners().end(), [&](const auto &corner) {
        const auto   offset = corner - tip.position;
        const double along = offset * tip.direction, aside = (offset - along * tip.direction).norm();
        return along <= spacing && aside <= spacing + straight * std::abs(along);
      });
    }
  } // namespace

  template <int dim>
  NearestNode nearest_node(const Problem<dim> &problem, const dealii::Point<dim> &point)
  {
    const Nodes<dim> &nodes = *problem.body.nodes;
    NearestNode       result;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      if (const double distance = nodes.position[i].distance(point); distance < result.distance)
        result = {distance, nodes.spacing[i], nodes.horizon[i], nodes.material[i]};
    const auto of_ranks = dealii::Utilities::MPI::min_max_avg(result.distance, problem.run.communicator);
    const auto values   = dealii::Utilities::MPI::broadcast(
      problem.run.communicator,
      std::array<double, 3>{{result.spacing, result.horizon, static_cast<double>(result.material)}},
      of_ranks.min_index);
    return {of_ranks.min, values[0], values[1], static_cast<dealii::types::material_id>(values[2])};
  }

  template <int dim>
  std::vector<CrackEnd<dim>> precrack_tips(const Problem<dim> &problem)
  {
    std::vector<CrackEnd<dim>> result;
    for (const CrackEnd<dim> &end : all_ends(problem))
      if (is_inside(problem, end))
        result.push_back(end);
    return result;
  }

  template <int dim>
  std::optional<CrackEnd<dim>> nearest_tip(const Problem<dim> &problem, const dealii::Point<dim> &point)
  {
    std::vector<CrackEnd<dim>> ends = all_ends(problem);
    std::stable_sort(ends.begin(), ends.end(), [&](const auto &a, const auto &b) {
      return a.nearest(point).distance(point) < b.nearest(point).distance(point);
    });
    for (const CrackEnd<dim> &end : ends)
      if (is_inside(problem, end))
        return end;
    return {};
  }

  CrackDriving::CrackDriving(const Problem<2> &problem)
    : problem(problem)
    , ends(precrack_tips(problem))
  {
  }

  double CrackDriving::room(const PlaneTip &tip) const
  {
    const Nodes<2>   &nodes  = *problem.body.nodes;
    const NearestNode own    = nearest_node(problem, tip.position);
    double            result = distance_to_surface(problem, tip.position);
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      if (nodes.material[i] != own.material)
        result = std::min(result, nodes.position[i].distance(tip.position) - nodes.spacing[i]);
    for (const auto &load : problem.loading.loads.point_loads)
      result = std::min(result, load.position.distance(tip.position));
    for (const auto &precrack : problem.failure.precracks)
      for (const Facet<2> &part : precrack.parts())
        if (!is_behind(tip, part, own.spacing))
          result = std::min(result, part.distance(tip.position));
    // Of a crack that grew, the tip that it left is no end any more.
    const auto left = std::min_element(ends.begin(), ends.end(), [&](const auto &a, const auto &b) {
      return a.middle().distance(tip.position) < b.middle().distance(tip.position);
    });
    for (auto end = ends.begin(); end != ends.end(); ++end)
      if (end != left)
        result = std::min(result, end->middle().distance(tip.position));
    return dealii::Utilities::MPI::min(result, problem.run.communicator);
  }

  double CrackDriving::radius_in(const PlaneTip &tip, const double room, const double horizon_at_tip) const
  {
    const Nodes<2> &nodes = *problem.body.nodes;
    for (double horizon = horizon_at_tip;;)
      {
        const double radius  = std::min(room - margin * horizon, Tip::most_horizons * horizon);
        double       largest = horizon;
        for (LocalIndex i = 0; i < nodes.size(); ++i)
          if (nodes.position[i].distance(tip.position) < radius)
            largest = std::max(largest, nodes.horizon[i]);
        largest = dealii::Utilities::MPI::max(largest, problem.run.communicator);
        if (largest == horizon)
          return radius;
        horizon = largest;
      }
  }

  CrackDriving::States CrackDriving::states(const std::vector<LocalIndex> &nodes) const
  {
    States result;
    if (const auto *by_law = dynamic_cast<const ContinuumForce<2> *>(problem.force.get()))
      {
        const auto gradients = by_law->gradients();
        for (const LocalIndex i : nodes)
          {
            result.gradient.push_back(gradients[i]);
            result.stress.push_back(by_law->law(i).stress(gradients[i]));
            result.energy_density.push_back(by_law->law(i).energy(gradients[i]));
          }
        return result;
      }
    if (!problem.force)
      {
        // Linear statics of the consistent form.
        const GradientMoments<2> &moments  = *problem.discretisation.gradients.moments;
        const auto                solid_of = solids_of_model(problem.body);
        moments.read(problem.state.unknowns, GradientMoments<2>::AtFaces::values);
        for (const LocalIndex i : nodes)
          {
            const auto gradient = to_tensor<2>(moments.gradient(i));
            const auto stress =
              solid_of(problem.body.nodes->material[i]).stiffness() * dealii::symmetrize(gradient);
            result.gradient.push_back(gradient);
            result.stress.push_back(stress);
            result.energy_density.push_back(0.5 * (stress * dealii::symmetrize(gradient)));
          }
        return result;
      }
    const Families<2>  &families     = *problem.discretisation.families;
    const BondForce<2> &force        = *problem.force;
    const NodalVector   displacement = displacement_of_families(problem);

    // Half of the energy of a bond belongs to either end.
    std::vector<double> energy(families.n_owned(), 0.);
    force.visit_bond_forces([&](const LocalIndex i, const LocalIndex j, const dealii::Tensor<1, 2> &pull) {
      double half = 0;
      for (unsigned int d = 0; d < 2; ++d)
        half +=
          0.25 * pull[d] * (displacement.local_element(2 * j + d) - displacement.local_element(2 * i + d));
      energy[i] += half;
      if (j < families.n_owned())
        energy[j] += half;
    });
    const auto stress = partial_stress(families, force);
    result.gradient   = intact_gradients(families, force, displacement, nodes);
    for (const LocalIndex i : nodes)
      {
        result.stress.push_back(stress[i]);
        result.energy_density.push_back(energy[i] / families.volume[i]);
      }
    return result;
  }

  DomainIntegral::Side CrackDriving::side(const PlaneTip &tip, const LocalIndex node) const
  {
    const Nodes<2>            &nodes = *problem.body.nodes;
    const dealii::Point<2>    &point = nodes.position[node];
    const dealii::Tensor<1, 2> left({-tip.direction[1], tip.direction[0]});
    const double               size = nodes.spacing[node];
    if (std::abs((point - tip.position) * left) > 1e-6 * size)
      return DomainIntegral::Side::automatic;
    // As the bonds of the node have it.
    const bool is_right =
      std::any_of(problem.failure.precracks.begin(), problem.failure.precracks.end(), [&](const auto &crack) {
        return crack.crosses(point, point + size * left);
      });
    return is_right ? DomainIntegral::Side::right : DomainIntegral::Side::left;
  }

  std::vector<CrackDriving::Result> CrackDriving::compute(const std::vector<Tip> &tips) const
  {
    const Nodes<2>             &nodes     = *problem.body.nodes;
    const double                thickness = problem.body.mesh->thickness;
    std::vector<Result>         result(tips.size());
    std::vector<DomainIntegral> integrals;
    for (std::size_t k = 0; k < tips.size(); ++k)
      {
        const NearestNode own    = nearest_node(problem, tips[k].tip.position);
        Result           &of_tip = result[k];
        of_tip.room              = std::min(room(tips[k].tip), tips[k].limit);
        of_tip.radius =
          tips[k].radius > 0 ? tips[k].radius : radius_in(tips[k].tip, of_tip.room, own.horizon);
        if (of_tip.radius < Tip::fewest_horizons * own.horizon || of_tip.radius > of_tip.room)
          of_tip.radius = 0;
        integrals.emplace_back(tips[k].tip,
                               inner_share * of_tip.radius,
                               of_tip.radius,
                               solids_of_model(problem.body)(own.material));
      }

    std::vector<LocalIndex> chosen;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      if (std::any_of(integrals.begin(), integrals.end(), [&](const auto &integral) {
            return integral.contains(nodes.position[i]);
          }))
        chosen.push_back(i);
    const States state = states(chosen);
    for (std::size_t k = 0; k < tips.size(); ++k)
      {
        if (result[k].radius == 0)
          continue;
        DomainIntegral &integral = integrals[k];
        for (std::size_t m = 0; m < chosen.size(); ++m)
          if (const LocalIndex i = chosen[m]; integral.contains(nodes.position[i]))
            integral.add({nodes.position[i],
                          nodes.volume[i] / thickness,
                          state.gradient[m],
                          state.stress[m],
                          state.energy_density[m],
                          side(tips[k].tip, i)});
        DomainIntegral::Sums sums;
        dealii::Utilities::MPI::sum(
          dealii::ArrayView<const double>(integral.sums().data(), integral.sums().size()),
          problem.run.communicator,
          dealii::ArrayView<double>(sums.data(), sums.size()));
        result[k].drive = integral.drive(sums);
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(nearest_node)
  PERIDEAL_INSTANTIATE(precrack_tips)
  PERIDEAL_INSTANTIATE(nearest_tip)
} // namespace perideal
