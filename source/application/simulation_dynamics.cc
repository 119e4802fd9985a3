// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/report.h>
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/stop_request.h>
#include <perideal/fracture/crack_tracker.h>
#include <perideal/fracture/fragments.h>
#include <perideal/output/files.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <limits>

// Simulation: explicit dynamics.

namespace perideal
{
  template <int dim>
  double Simulation<dim>::critical_stretch(const dealii::types::material_id id, const double horizon) const
  {
    const MaterialProperties &material = properties_of(id);
    if (material.critical_stretch > 0)
      return material.critical_stretch;
    if (material.fracture_energy > 0)
      return parameters.model.critical_stretch(
        scene.solids.at(id).isotropic(), material.fracture_energy, horizon);
    return std::numeric_limits<double>::infinity();
  }

  template <int dim>
  double Simulation<dim>::choose_time_step()
  {
    const Timings::Scope scope(timings, "setup");
    const double         stable = largest_stable_step();
    const double         wanted = parameters.solver.time_step > 0 ? parameters.solver.time_step :
                                                                    parameters.solver.time_step_safety * stable;
    // A whole number of steps.
    const double n_steps = std::max(1., std::ceil(parameters.solver.end_time / wanted - 1e-9));
    const double result =
      resumed ? resumed->header.at("time step").template get<double>() : parameters.solver.end_time / n_steps;
    if (result > stable)
      screen << "warning     the time step " << short_number(result)
             << " s is larger than the largest stable one, " << short_number(stable) << " s" << std::endl;
    summary["solver"]["time_step"]        = result;
    summary["solver"]["stable_time_step"] = stable;
    return result;
  }

  template <int dim>
  BondPredicate<dim> Simulation<dim>::precrack_test() const
  {
    if (scene.precracks.empty())
      return {};
    return [this](const dealii::Point<dim> &a, const dealii::Point<dim> &b) {
      return std::any_of(scene.precracks.begin(), scene.precracks.end(), [&](const auto &crack) {
        return crack.crosses(a, b);
      });
    };
  }

  template <int dim>
  void Simulation<dim>::make_cracks_and_limits()
  {
    if (!scene.precracks.empty())
      summary["damage"]["cut_bonds"] = scene.force->cut(precrack_test());
    if (!can_break(parameters))
      return;
    const Families<dim> &families = *scene.families;
    std::vector<bool>    unbreakable(families.n_local(), false);
    if (scene.no_fail_zones)
      for (LocalIndex i = 0; i < families.n_local(); ++i)
        unbreakable[i] = scene.no_fail_zones->contains(families.position[i]);
    if (scene.correspondence)
      {
        set_strengths(
          [&](const LocalIndex i, const LocalIndex j) { return !unbreakable[i] && !unbreakable[j]; });
        return;
      }
    scene.force->set_critical_stretch([&](const LocalIndex i, const LocalIndex j) {
      if (unbreakable[i] || unbreakable[j])
        return std::numeric_limits<double>::infinity();
      // Between unequal horizons the mean, between materials the weaker one (XOSB eqs. 81, 86).
      const double horizon = 0.5 * (families.horizon[i] + families.horizon[j]);
      return std::min(critical_stretch(families.material[i], horizon),
                      critical_stretch(families.material[j], horizon));
    });
  }

  template <int dim>
  void Simulation<dim>::prepare_dynamics()
  {
    const char *axes[] = {"x", "y", "z"};
    for (int d = 0; d < dim; ++d)
      scene.initial_velocity[d] = SpaceTimeFunction<dim>(parameters.initial.velocity[d],
                                                         std::string("Initial conditions/v_") + axes[d]);
    if (dim == 2 && !parameters.initial.velocity[2].empty())
      throw InputError("a two-dimensional scene has no z component").parameter("Initial conditions/v_z");
    prepare_cracks();
  }

  template <int dim>
  void Simulation<dim>::prepare_cracks()
  {
    for (const PrecrackText &text : parameters.precracks.cracks)
      scene.precracks.emplace_back(text, *scene.mesh);
    if (!parameters.no_fail.zones.empty())
      {
        scene.no_fail_zones   = std::make_unique<NoFailZones<dim>>(parameters.no_fail, *scene.mesh);
        scene.n_no_fail_nodes = scene.no_fail_zones->count(*scene.nodes);
        summary["damage"]["no_fail_nodes"] = scene.n_no_fail_nodes;
      }
    if (!parameters.cracks.cracks.empty())
      scene.crack_tracker = std::make_unique<CrackTracker<dim>>(parameters.cracks, *scene.nodes);
  }

  template <int dim>
  void Simulation<dim>::run_dynamics()
  {
    prepare_dynamics();
    if (parameters.checkpoints.restart)
      open_checkpoint();
    weigh_bonds();
    make_relative_damping();
    const double        time_step = choose_time_step();
    std::vector<double> mass(scene.nodes->size());
    {
      const Timings::Scope scope(timings, "setup");
      scene.force = create_bond_force<dim>(*scene.weights);
      make_cracks_and_limits();
      make_contact();
      // What only the time step needed.
      scene.system.reset();
      scene.bonds.reset();
      if (parameters.model.recomputes())
        scene.force->reweigh_as_bonds_break(scene.weights, [&](const auto &nodes, const auto &is_gone) {
          scene.weights->reweigh(nodes, *scene.model, solid_of_model(), is_gone);
        });
      else
        {
          scene.weights.reset();
          scene.families->release_members();
        }
      for (LocalIndex i = 0; i < mass.size(); ++i)
        mass[i] = properties_of(scene.nodes->material[i]).density * scene.nodes->volume[i];
    }
    const bool verlet         = parameters.solver.integrator == Integrator::velocity_verlet;
    summary["solver"]["name"] = "explicit dynamics, " + name_of(parameters.solver.integrator);
    announce("time        " + short_number(parameters.solver.end_time) + " s in " +
             std::to_string(std::lround(parameters.solver.end_time / time_step)) + " steps of " +
             short_number(time_step) + " s, " + name_of(parameters.solver.integrator) + "\n");
    open_outputs();

    ExplicitDynamics<dim> dynamics(*scene.force,
                                   scene.held,
                                   scene.loads,
                                   mass,
                                   parameters.solver.damping,
                                   time_step,
                                   verlet ? ExplicitDynamics<dim>::Start::velocity_verlet :
                                            ExplicitDynamics<dim>::Start::symplectic_euler);
    if (scene.contact)
      dynamics.set_contact(scene.contact.get());
    if (scene.relative_damping)
      dynamics.set_relative_damping(scene.relative_damping.get());
    for (int d = 0; d < dim; ++d)
      if (scene.initial_velocity[d].is_present())
        for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
          dynamics.velocity.local_element(dim * i + d) =
            scene.initial_velocity[d].value(scene.nodes->position[i], 0.);
    if (scene.crack_tracker)
      scene.crack_tracker->start(scene.force->cut_share());
    if (resumed)
      resume(dynamics);
    bool reached_end = false;
    try
      {
        reached_end = run_steps(dynamics, time_step);
        warn_of_large_rotations();
      }
    catch (const ComputationError &)
      {
        finish("failed");
        throw;
      }
    finish(reached_end ? "done" : "stopped");
    if (!reached_end)
      throw ComputationError(describe_stop("step " + std::to_string(dynamics.step()) +
                                           ", t = " + short_number(dynamics.time()) + " s"));
  }

  template <int dim>
  bool Simulation<dim>::run_steps(ExplicitDynamics<dim> &dynamics, const double time_step)
  {
    const unsigned int n_steps = std::ceil(parameters.solver.end_time / time_step - 1e-6);
    const StopRequest  stop;
    scene.force->initialize(external_force);
    check_finite(scene.faces, scene.loads, parameters.solver.end_time, communicator);
    scene.held.check_finite(scene.loads, parameters.solver.end_time, communicator);
    apply_forces(dynamics.time());
    const bool        loads_change = scene.loads.forces_depend_on_time();
    const GlobalIndex n_bonds      = scene.families->n_bonds();
    StepLine          progress(screen.get_stream(), screen.is_active(), n_steps);
    for (unsigned int n = dynamics.step(); n <= n_steps; ++n)
      {
        {
          const Timings::Scope scope(timings, "solve");
          if (loads_change && n > 0)
            apply_forces(dynamics.time());
          dynamics.evaluate(external_force);
        }
        if (dynamics.n_broken() > 0 && !summary["damage"].contains("first_break_time"))
          summary["damage"]["first_break_time"] = dynamics.time();
        if (scene.crack_tracker && dynamics.n_broken_now() > 0)
          scene.crack_tracker->update(dynamics.time(), total_damage());
        if (dynamics.n_broken_now() > 0 && dynamics.n_broken() == n_bonds)
          {
            record_dynamics(dynamics);
            throw ComputationError(
              "every bond is broken at step " + std::to_string(n) + ", t = " + short_number(dynamics.time()) +
              " s\n  likely cause: a critical stretch or fracture energy that is too small, or "
              "loads that are too large");
          }
        progress(n, dynamics.n_broken());
        summary["solver"]["steps"] = n;
        if (n % parameters.history_steps == 0 || n == n_steps)
          record_dynamics(dynamics);
        while (frame_times.size() < parameters.frames &&
               n >= std::round(double(frame_times.size() + 1) * n_steps / parameters.frames))
          {
            frame_times.push_back(dynamics.time());
            write_frame(frame_times.size(), dynamics);
          }
        if (n == n_steps)
          break;
        {
          const Timings::Scope scope(timings, "solve");
          dynamics.advance();
        }
        const bool stops = stop.is_there(communicator);
        if (stops || (parameters.checkpoints.steps > 0 && (n + 1) % parameters.checkpoints.steps == 0))
          save_checkpoint(dynamics, time_step);
        if (stops)
          return false;
      }
    compare_at_end(dynamics.time());
    if (scene.crack_tracker)
      {
        summary["cracks"] = scene.crack_tracker->describe();
        scene.crack_tracker->write_paths(parameters.output_directory);
      }
    if (can_break(parameters))
      summary["damage"]["fragments"] = find_fragments(*scene.families,
                                                      scene.force->bond_list(),
                                                      scene.nodes->spacing,
                                                      total_damage(),
                                                      parameters.cracks.damage);
    return true;
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
