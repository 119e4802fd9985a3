// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/output/lasting_state.h>
#include <perideal/solvers/explicit_dynamics.h>

#include <deal.II/base/mpi.h>

#include <utility>

namespace perideal
{
  template <int dim>
  ExplicitDynamics<dim>::ExplicitDynamics(BondForce<dim>            &bonds,
                                          const DirichletNodes<dim> &held,
                                          const Loads<dim>          &loads,
                                          const std::vector<double> &mass,
                                          const double               damping,
                                          const double               time_step,
                                          const Start                start)
    : bonds(bonds)
    , loads(loads)
    , held{held}
    , mass(mass)
    , scheme{damping, time_step, start}
  {
    for (NodalVector *vector :
         {&displacement, &velocity, &work.force, &work.earlier_velocity, &work.support_force})
      bonds.initialize(*vector);
  }

  template <int dim>
  void ExplicitDynamics<dim>::set_relative_damping(RelativeDamping<dim> *relative)
  {
    added.damping = relative;
    bonds.initialize(work.relative_drag);
  }

  template <int dim>
  void ExplicitDynamics<dim>::take_sub_steps(const std::shared_ptr<const LocalSteps> &steps)
  {
    added.sub_steps =
      std::make_unique<SubSteps<dim>>(bonds, steps, mass, held.nodes.mask(), scheme.time_step);
  }

  template <int dim>
  void ExplicitDynamics<dim>::take_steps_between(const NodalVector &external)
  {
    const auto of_others = [&](const std::size_t k) {
      return external.local_element(k) - scheme.damping * mass[k / dim] * velocity.local_element(k);
    };
    for (std::size_t k = 0; k < dim * mass.size(); ++k)
      work.force.local_element(k) += of_others(k);
    own.between = added.sub_steps->take_steps(work.force);
    for (std::size_t k = 0; k < dim * mass.size(); ++k)
      work.force.local_element(k) -= of_others(k);
  }

  template <int dim>
  void ExplicitDynamics<dim>::move_faces(FaceValues<dim>                           &values,
                                         const std::vector<dealii::Tensor<1, dim>> &start)
  {
    held.faces = &values;
    held.moved.assign(values.entries().size(), dealii::Tensor<1, dim>());
    values.set_values(start);
    // What velocities sum up to is found as it was: step by step.
    for (std::uint64_t step = 0; step < n_steps; ++step)
      {
        values.prepare_step(loads, step * scheme.time_step, scheme.time_step);
        for (std::size_t e = 0; e < held.moved.size(); ++e)
          held.moved[e] = values.entries()[e].increment;
        values.move();
      }
  }

  template <int dim>
  void ExplicitDynamics<dim>::move_held_nodes(const NodalVector &start)
  {
    NodalVector                      place   = start;
    const std::vector<std::uint8_t> &is_held = held.nodes.mask();
    const auto                       visit   = [&](const auto &move) {
      for (std::size_t k = 0; k < is_held.size(); ++k)
        if (is_held[k])
          move(k);
    };
    for (std::uint64_t step = 0; step < n_steps; ++step)
      {
        held.nodes.set_velocities(loads, step * scheme.time_step, scheme.time_step, place, velocity);
        visit([&](const std::size_t k) {
          place.local_element(k) += scheme.time_step * velocity.local_element(k);
        });
      }
    visit([&](const std::size_t k) { displacement.local_element(k) = place.local_element(k); });
  }

  template <int dim>
  void ExplicitDynamics<dim>::work_of_faces()
  {
    held.faces->prepare_step(loads, time(), scheme.time_step);
    const auto  force   = face_reaction();
    const auto &entries = held.faces->entries();
    for (std::size_t e = 0; e < entries.size(); ++e)
      {
        if (n_steps > 0)
          own.external_work += 0.5 * (force[e] * held.moved[e]);
        held.moved[e] = entries[e].increment;
        own.next_external_work += 0.5 * (force[e] * held.moved[e]);
      }
  }

  template <int dim>
  void ExplicitDynamics<dim>::evaluate(const NodalVector &external)
  {
    if (added.sub_steps)
      added.sub_steps->compute(work.force, displacement);
    else
      bonds.compute(work.force, displacement);
    breaks.now = bonds.n_broken_now();
    breaks.total += breaks.now;
    if (added.contact)
      added.contact->add(work.force, bonds);
    if (added.sub_steps)
      take_steps_between(external);
    if (n_steps == 0 && scheme.start == Start::velocity_verlet)
      scheme.later = 0.5 * scheme.time_step;
    if (const double later = std::exchange(scheme.later, 0.); later != 0)
      for (std::size_t k = 0; k < dim * mass.size(); ++k)
        if (n_steps == 0 || !held.nodes.mask()[k])
          velocity.local_element(k) -=
            later * (work.force.local_element(k) + external.local_element(k)) / mass[k / dim];
    breaks.switched += bonds.switched_energy(velocity, scheme.time_step);
    const SofteningBonds &softening = bonds.softening_bonds();
    if (softening.softens() ? softening.any_now(displacement.get_mpi_communicator()) : breaks.now > 0)
      breaks.energy += bonds.released_energy(velocity, scheme.time_step);

    work.earlier_velocity.swap(velocity);
    if (added.damping)
      added.damping->compute(work.relative_drag, work.earlier_velocity, bonds);
    held.nodes.set_velocities(loads, time(), scheme.time_step, displacement, velocity);
    const std::uint8_t *is_held = held.nodes.mask().data();
    const double *f = work.force.begin(), *p = external.begin(), *before = work.earlier_velocity.begin();
    const double *relative = added.damping ? work.relative_drag.begin() : nullptr;
    double       *after = velocity.begin(), *support = work.support_force.begin();
    // Twice the work that the forces do in the halves of a step before and after the present time.
    double kinetic_sum = 0, work_before = 0, work_after = 0, damped_before = 0, damped_after = 0;
    for (std::size_t i = 0; i < mass.size(); ++i)
      for (std::size_t k = dim * i; k < dim * (i + 1); ++k)
        {
          const double drag = scheme.damping * mass[i] * before[k] - (relative ? relative[k] : 0.);
          const double free = f[k] + p[k] - drag;
          if (is_held[k])
            support[k] = mass[i] * (after[k] - before[k]) / scheme.time_step - free;
          else
            after[k] = before[k] + scheme.time_step * free / mass[i];
          kinetic_sum += mass[i] * before[k] * after[k];
          work_before += (p[k] + support[k]) * before[k];
          work_after += (p[k] + support[k]) * after[k];
          damped_before += drag * before[k];
          damped_after += drag * after[k];
        }
    own.kinetic = 0.5 * kinetic_sum + own.between;
    // At the beginning the initial motion and strain are there: what they hold counts as put in.
    own.external_work +=
      n_steps == 0 ? own.kinetic : own.next_external_work + 0.5 * scheme.time_step * work_before;
    if (n_steps == 0)
      {
        if (added.sub_steps)
          added.sub_steps->settle(displacement);
        add_work(bonds.strain_energy() + breaks.energy);
      }
    own.damped += n_steps == 0 ? 0. : own.next_damped + 0.5 * scheme.time_step * damped_before;
    own.next_external_work = 0.5 * scheme.time_step * work_after;
    own.next_damped        = 0.5 * scheme.time_step * damped_after;
    if (held.faces)
      work_of_faces();
  }

  template <int dim>
  void ExplicitDynamics<dim>::add_work(const double of_all)
  {
    if (dealii::Utilities::MPI::this_mpi_process(displacement.get_mpi_communicator()) == 0)
      own.external_work += of_all;
  }

  template <int dim>
  void ExplicitDynamics<dim>::advance()
  {
    displacement.add(scheme.time_step, velocity);
    if (held.faces)
      held.faces->move();
    ++n_steps;
  }

  template <int dim>
  void ExplicitDynamics<dim>::register_state(LastingState &state)
  {
    state.add_node_array("displacement", "m", dim, displacement);
    state.add_node_array("velocity", "m/s", dim, velocity);
    state.add_value("number of steps", n_steps);
    state.add_value("number of broken bonds", breaks.total);
    state.add_value("dissipated energy", breaks.energy);
    state.add_value("switched energy", breaks.switched);
    state.add_sum("damped energy", own.damped);
    state.add_sum("external work", own.external_work);
    state.add_sum("damped energy to come", own.next_damped);
    state.add_sum("external work to come", own.next_external_work);
  }

  template <int dim>
  EnergyBudget ExplicitDynamics<dim>::energy() const
  {
    const MPI_Comm communicator = displacement.get_mpi_communicator();
    using dealii::Utilities::MPI::sum;
    if (added.sub_steps)
      added.sub_steps->settle(displacement);
    EnergyBudget result;
    result.kinetic    = sum(own.kinetic, communicator);
    result.strain     = bonds.strain_energy();
    result.contact    = added.contact ? added.contact->energy() : 0.;
    result.dissipated = breaks.energy;
    result.switched   = breaks.switched;
    result.damped     = sum(own.damped, communicator);
    result.external   = sum(own.external_work, communicator);
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim> ExplicitDynamics<dim>::momentum() const
  {
    dealii::Tensor<1, dim> result;
    for (std::size_t i = 0; i < mass.size(); ++i)
      for (int d = 0; d < dim; ++d)
        result[d] += mass[i] * velocity.local_element(dim * i + d);
    return dealii::Utilities::MPI::sum(result, displacement.get_mpi_communicator());
  }

  template <int dim>
  dealii::Tensor<1, 3> ExplicitDynamics<dim>::angular_momentum() const
  {
    const NodeRecord    *y = bonds.positions();
    dealii::Tensor<1, 3> result;
    for (std::size_t i = 0; i < mass.size(); ++i)
      {
        dealii::Tensor<1, 3> arm, moving;
        for (int d = 0; d < dim; ++d)
          {
            arm[d]    = y[i].value[d];
            moving[d] = mass[i] * velocity.local_element(dim * i + d);
          }
        result += cross_product_3d(arm, moving);
      }
    return dealii::Utilities::MPI::sum(result, displacement.get_mpi_communicator());
  }

  PERIDEAL_INSTANTIATE_CLASS(ExplicitDynamics)
} // namespace perideal
