// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/finite.h>
#include <perideal/base/instantiate.h>
#include <perideal/solvers/equilibrium_path.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// Relative residual at which bonds are judged.
    constexpr double judge_tolerance = 1e-4;
    /// How often the iterations of a load step are counted anew as bonds soften.
    constexpr unsigned int most_patience = 20;
  } // namespace

  template <int dim>
  EquilibriumPath<dim>::EquilibriumPath(BondForce<dim>                 &bonds,
                                        const ConstrainedOperator<dim> &system,
                                        const DirichletNodes<dim>      &held,
                                        const Loads<dim>               &loads,
                                        const Controls                 &controls,
                                        FaceValues<dim>                *face_values)
    : bonds(bonds)
    , held(held)
    , loads(loads)
    , controls(controls)
    , face_values(face_values)
  {
    if (face_values != nullptr)
      {
        last.face_support_force.resize(face_values->entries().size());
        last.face_value.resize(face_values->entries().size());
      }
    for (NodalVector *vector : {&displacement,
                                &force,
                                &earlier_force,
                                &increment,
                                &last.displacement,
                                &last.external,
                                &last.imbalance,
                                &last.motion,
                                &last.support_force})
      bonds.initialize(*vector);
    bonds.judge_bonds(Judgement::on_trial);
    const NodeCloud<dim> &nodes = system.mirror_layer().nodes();
    for (LocalIndex i = 0; i < system.n_nodes(); ++i)
      for (int d = 0; d < dim; ++d)
        rounding.rest_position.push_back(nodes.position[i][d]);
  }

  template <int dim>
  EquilibriumStep
  EquilibriumPath<dim>::step(const NodalVector &external, const double time, const Progress &progress)
  {
    start_step(external, time);
    increment      = 0.;
    breaks.in_step = false;
    EquilibriumStep result;
    unsigned int    since_break = 0;
    const bool      can_break   = controls.bonds_break && !breaks.wait;
    bool            judged      = !can_break;
    const auto      end_step    = [&](const Norms &norms) {
      last.note(norms);
      balance(external, force, bonds.strain_energy());
      if (!breaks.wait)
        last.note_step(increment, time);
      result.converged = true;
      return result;
    };
    compute_forces();
    while (true)
      {
        const Norms  norms     = measure(external);
        const double reference = std::sqrt(std::max({norms.reaction, norms.load, last.largest_load}));
        const double residual  = std::sqrt(norms.residual);
        result.residuals.push_back(reference > 0 ? residual / reference : (residual > 0 ? 1. : 0.));
        progress(result.iterations, result.residuals.back());
        if (result.iterations == 0)
          require_finite(reference + residual, "the residual before the first iteration");
        if (!is_finite(reference + residual))
          return result;
        const bool at_rest =
          is_in_place() && residual <= std::max(controls.tolerance * reference, rounding.force);
        const bool nearly = is_in_place() && !judged && !bonds.softening_bonds().softens() &&
                            residual <= judge_tolerance * reference;
        if (can_break && (at_rest || nearly))
          {
            if (breaks.most_dissipated < std::numeric_limits<double>::infinity() &&
                dissipated_since(external) > breaks.most_dissipated)
              {
                result.problem = "the step dissipates more than it may";
                return result;
              }
            if (!judged && controls.wants_mesh && !bonds.softening_bonds().softens() && controls.wants_mesh())
              {
                result.wants_mesh = true;
                return end_step(norms);
              }
            if (extend_bonds())
              {
                since_break = 0;
                continue;
              }
            const GlobalIndex now = judge(external);
            result.broken += now;
            judged = now == 0;
            if (now > 0)
              {
                last.note(norms);
                since_break = 0;
                continue;
              }
          }
        if (at_rest)
          return end_step(norms);
        if (since_break == controls.max_iterations)
          return result;
        if (!iterate(external, result))
          return result;
        const bool goes_on =
          breaks.in_iteration && result.iterations < most_patience * controls.max_iterations;
        since_break         = goes_on ? 0 : since_break + 1;
        breaks.in_iteration = false;
        ++result.iterations;
      }
  }

  template <int dim>
  void EquilibriumPath<dim>::set_rounding(const NodalVector &stiffness)
  {
    // Forces that stay were measured to be twice eps |y| times the masses of dynamic relaxation at most.
    double sum = 0;
    for (std::size_t k = 0; k < rounding.rest_position.size(); ++k)
      {
        const double y =
          stiffness.local_element(k) * (rounding.rest_position[k] + displacement.local_element(k));
        sum += y * y;
      }
    sum            = dealii::Utilities::MPI::sum(sum, displacement.get_mpi_communicator());
    rounding.force = 2 * std::numeric_limits<double>::epsilon() * std::sqrt(sum);
  }

  template <int dim>
  void EquilibriumPath<dim>::compute_forces()
  {
    earlier_force.swap(force);
    bonds.compute(force, displacement);
  }

  template <int dim>
  void EquilibriumPath<dim>::restore()
  {
    displacement = last.displacement;
    if (face_values != nullptr)
      face_values->set_values(last.face_value);
  }

  template <int dim>
  void EquilibriumPath<dim>::register_state(LastingState &state)
  {
    state.add_node_array("displacement", "m", dim, displacement);
    state.add_value("number of broken bonds", breaks.total);
    state.add_value("strain energy", last.energy.strain);
    state.add_value("dissipated energy", last.energy.dissipated);
    state.add_value("external work", last.energy.external);
    state.add_value("switched energy", last.energy.switched);
    state.add_value("largest load", last.largest_load);
    state.add_node_array("motion of the last load step", "m", dim, last.motion);
    state.add_value("end of the last load step", last.time);
    state.add_value("change of t in the last load step", last.time_change);
  }

  template <int dim>
  void EquilibriumPath<dim>::resume(const NodalVector &external, const double time)
  {
    if (face_values != nullptr)
      face_values->set_time(loads, time);
    compute_forces();
    keep(external, force);
  }

  template <int dim>
  EquilibriumStep
  EquilibriumPath<dim>::come_to_rest(const NodalVector &external, const double time, const Progress &progress)
  {
    const EnergyBudget before = last.energy;
    bonds.judge_bonds(Judgement::none);
    breaks.wait                  = true;
    const EquilibriumStep result = step(external, time, progress);
    breaks.wait                  = false;
    bonds.judge_bonds(Judgement::on_trial);
    last.energy.switched += before.strain - last.energy.strain + last.energy.external - before.external;
    return result;
  }

  template <int dim>
  GlobalIndex EquilibriumPath<dim>::judge(const NodalVector &external)
  {
    bonds.judge_bonds(Judgement::for_good);
    compute_forces();
    bonds.judge_bonds(Judgement::on_trial);
    const GlobalIndex now = bonds.n_broken_now();
    breaks.total += now;
    if (bonds.softening_bonds().any_now(displacement.get_mpi_communicator()))
      breaks.in_step = breaks.in_segment = breaks.in_iteration = true;
    if (now == 0)
      return 0;
    forget_motion();
    if (bonds.softening_bonds().softens())
      return now;
    // At rest, the energy that goes at once is that of the weights lost.
    NodalVector no_velocity(force);
    no_velocity = 0.;
    balance(external, earlier_force, bonds.strain_energy() + bonds.released_energy(no_velocity, 0.));
    breaks.in_step = breaks.in_segment = true;
    return now;
  }

  PERIDEAL_INSTANTIATE_CLASS(EquilibriumPath)
} // namespace perideal
