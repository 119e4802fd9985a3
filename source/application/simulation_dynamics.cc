// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/advice.h>
#include <perideal/application/output_fields.h>
#include <perideal/application/report.h>
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/stop_request.h>
#include <perideal/boundary/nodal_forces.h>
#include <perideal/fracture/crack_tracker.h>
#include <perideal/fracture/critical_stretch.h>
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
      return ordinary_critical_stretch(
        parameters.model.constants_of_model(scene.constants.at(id)), material.fracture_energy, horizon);
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
      scene.weights.reset();
      scene.families->release_members();
      for (LocalIndex i = 0; i < mass.size(); ++i)
        mass[i] = properties_of(scene.nodes->material[i]).density * scene.nodes->volume[i];
    }
    const bool verlet         = parameters.solver.integrator == "velocity verlet";
    summary["solver"]["name"] = "explicit dynamics, " + parameters.solver.integrator;
    screen << banner(parameters, scene) << "time        " << short_number(parameters.solver.end_time)
           << " s in " << std::lround(parameters.solver.end_time / time_step) << " steps of "
           << short_number(time_step) << " s, " << parameters.solver.integrator << std::endl;
    for (const std::string &warning : warnings(parameters, scene))
      screen << "warning     " << warning << std::endl;

    history =
      std::make_unique<History>(parameters.output_directory,
                                communicator,
                                resumed ? resumed->header.at("step").template get<double>() - 0.5 : -1.);
    field_output = std::make_unique<FieldOutput<dim>>(
      *scene.mesh, *scene.nodes, parameters.output_directory, OutputSteps::series);

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
      }
    catch (const ComputationError &)
      {
        finish("failed");
        throw;
      }
    finish(reached_end ? "done" : "stopped");
    if (!reached_end)
      throw ComputationError(
        "asked to stop after step " + std::to_string(dynamics.step()) +
        ", t = " + short_number(dynamics.time()) +
        " s; the checkpoint is written\n  advice: to go on, run the same scene with --set "
        "Checkpoints/Restart=true");
  }

  template <int dim>
  bool Simulation<dim>::run_steps(ExplicitDynamics<dim> &dynamics, const double time_step)
  {
    const unsigned int n_steps = std::ceil(parameters.solver.end_time / time_step - 1e-6);
    const StopRequest  stop;
    scene.force->initialize(external_force);
    check_finite(
      scene.faces, scene.loads, scene.condition_boundaries, parameters.solver.end_time, communicator);
    const auto set_loads = [&]() {
      compute_nodal_forces(
        *scene.nodes, scene.faces, scene.loads, scene.condition_boundaries, dynamics.time(), external_force);
      scene.point_forces.add(scene.loads, dynamics.time(), external_force);
    };
    set_loads();
    const bool        loads_change = scene.loads.forces_depend_on_time();
    const GlobalIndex n_bonds      = scene.families->n_bonds();
    StepLine          progress(screen.get_stream(), screen.is_active(), n_steps);
    for (unsigned int n = dynamics.step(); n <= n_steps; ++n)
      {
        {
          const Timings::Scope scope(timings, "solve");
          if (loads_change && n > 0)
            set_loads();
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

  template <int dim>
  std::vector<double> Simulation<dim>::total_damage() const
  {
    std::vector<double>       result = scene.force->damage();
    const std::vector<double> cut    = scene.force->cut_share();
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] += cut[i];
    return result;
  }

  template <int dim>
  void Simulation<dim>::check_finite_motion(const ExplicitDynamics<dim> &dynamics, const EnergyBudget &energy)
  {
    if (std::isfinite(energy.kinetic) && std::isfinite(energy.strain))
      return;
    double     fastest = 0;
    LocalIndex node    = 0;
    for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
      for (int d = 0; d < dim; ++d)
        if (!(std::abs(dynamics.velocity.local_element(dim * i + d)) <= fastest))
          {
            fastest = std::abs(dynamics.velocity.local_element(dim * i + d));
            node    = i;
          }
    std::ostringstream where;
    if (scene.nodes->size() > 0)
      where << scene.nodes->first_global + node << " at (" << scene.nodes->position[node] << ")";
    throw ComputationError("the motion is not finite at step " + std::to_string(dynamics.step()) + ", t = " +
                           short_number(dynamics.time()) + " s, first seen at node " + where.str() +
                           "\n  likely cause: an unstable time step; the largest stable one is " +
                           short_number(summary["solver"]["stable_time_step"].template get<double>()) +
                           " s\n  advice: set Solver/Time step = 0");
  }

  template <int dim>
  void Simulation<dim>::record_dynamics(const ExplicitDynamics<dim> &dynamics)
  {
    const Timings::Scope scope(timings, "energy");
    const EnergyBudget   energy = dynamics.energy();
    check_finite_motion(dynamics, energy);
    store_motion(dynamics);
    largest_energy     = std::max({largest_energy, std::abs(energy.external), energy.kinetic});
    const double drift = largest_energy > 0 ? energy.imbalance() / largest_energy : 0.;
    history->add("step", dynamics.step());
    history->add("time [s]", dynamics.time());
    history->add("kinetic energy [J]", energy.kinetic);
    history->add("strain energy [J]", energy.strain);
    if (scene.contact)
      history->add("contact energy [J]", energy.contact);
    history->add("dissipated energy [J]", energy.dissipated);
    history->add("damped energy [J]", energy.damped);
    history->add("external work [J]", energy.external);
    history->add("drift [-]", drift);
    history->add("broken bonds", dynamics.n_broken());
    const auto  reactions = scene.held.sum_by_condition(dynamics.reaction(), communicator);
    const char *axes[]    = {"x", "y", "z"};
    for (std::size_t k = 0; k < scene.loads.conditions.size(); ++k)
      if (scene.loads.conditions[k].prescribes_displacement())
        for (int d = 0; d < dim; ++d)
          history->add("reaction of " + scene.loads.conditions[k].name + " along " + axes[d] + " [N]",
                       reactions[k][d]);
    if (scene.crack_tracker)
      record_crack_tips(dynamics.n_broken(), dynamics.time());
    history->end_row();
    double worst = summary.contains("energy") ? summary["energy"]["drift"].template get<double>() : 0.;
    if (std::abs(drift) > std::abs(worst))
      worst = drift;
    summary["energy"]                     = {{"strain", energy.strain},
                                             {"kinetic", energy.kinetic},
                                             {"contact", energy.contact},
                                             {"dissipated", energy.dissipated},
                                             {"damped", energy.damped},
                                             {"external", energy.external},
                                             {"drift", worst}};
    summary["damage"]["broken_bonds"]     = dynamics.n_broken();
    summary["momentum"]                   = nlohmann::ordered_json::array();
    const dealii::Tensor<1, dim> momentum = dynamics.momentum();
    for (int d = 0; d < dim; ++d)
      summary["momentum"].push_back(momentum[d]);
    if (scene.contact)
      {
        const double before =
          summary.contains("contact") ? summary["contact"].value("largest_overlap", 0.) : 0.;
        summary["contact"] = {{"pairs", scene.contact->n_contacts()},
                              {"largest_overlap", std::max(before, scene.contact->largest_overlap())},
                              {"searches", scene.contact->n_searches()}};
      }
  }

  template <int dim>
  void Simulation<dim>::record_crack_tips(const GlobalIndex n_broken, const double time)
  {
    if (n_broken != broken_in_cracks)
      scene.crack_tracker->collect();
    broken_in_cracks   = n_broken;
    const char *axes[] = {"x", "y", "z"};
    for (const auto &tip : scene.crack_tracker->tips(time))
      {
        for (int d = 0; d < dim; ++d)
          history->add(std::string("tip ") + axes[d] + " of " + tip.name + " [m]", tip.position[d]);
        history->add("reach of " + tip.name + " [m]", tip.reach);
        history->add("speed of " + tip.name + " [m/s]", tip.speed);
      }
  }

  template <int dim>
  void Simulation<dim>::store_motion(const ExplicitDynamics<dim> &dynamics)
  {
    motion_time = dynamics.time();
    scene.displacement.resize(scene.nodes->size());
    scene.velocity.resize(scene.nodes->size());
    for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
      for (int d = 0; d < dim; ++d)
        {
          scene.displacement[i][d] = dynamics.displacement.local_element(dim * i + d);
          scene.velocity[i][d]     = dynamics.velocity.local_element(dim * i + d);
        }
  }

  template <int dim>
  void Simulation<dim>::write_frame(const unsigned int number, const ExplicitDynamics<dim> &dynamics)
  {
    const Timings::Scope scope(timings, "output");
    if (motion_time != dynamics.time())
      {
        check_finite_motion(dynamics, dynamics.energy());
        store_motion(dynamics);
      }
    add_output_fields(scene, parameters.field_names(), *field_output);
    field_output->write(number, dynamics.time());
    frame_time = dynamics.time();
  }

#define PERIDEAL_INSTANTIATE(dim)                                                                            \
  template double Simulation<dim>::critical_stretch(const dealii::types::material_id, const double) const;   \
  template BondPredicate<dim>  Simulation<dim>::precrack_test() const;                                       \
  template void                Simulation<dim>::prepare_dynamics();                                          \
  template void                Simulation<dim>::prepare_cracks();                                            \
  template void                Simulation<dim>::make_cracks_and_limits();                                    \
  template std::vector<double> Simulation<dim>::total_damage() const;                                        \
  template void                Simulation<dim>::run_dynamics();
  PERIDEAL_INSTANTIATE(2)
  PERIDEAL_INSTANTIATE(3)
#undef PERIDEAL_INSTANTIATE
} // namespace perideal
