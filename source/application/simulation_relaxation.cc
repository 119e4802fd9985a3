// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/areal_forces.h>
#include <perideal/application/gauge_records.h>
#include <perideal/application/prescribed_displacements.h>
#include <perideal/application/report.h>
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/stop_request.h>
#include <perideal/fracture/fragments.h>
#include <perideal/operators/force/correspondence_force.h>
#include <perideal/output/summary.h>
#include <perideal/solvers/dynamic_relaxation.h>

#include <deal.II/base/mpi.h>

#include <cmath>

// Simulation: equilibria of the nonlinear force along load steps, with failure, by dynamic relaxation or
// whatever finds them.

namespace perideal
{
  namespace
  {
    /// Forces of the supports, and the largest so far: what the body bore.
    template <int dim>
    void record_reactions(const Loads<dim>                          &loads,
                          const std::vector<dealii::Tensor<1, dim>> &sums,
                          History                                   &history,
                          nlohmann::ordered_json                    &summary)
    {
      const char            *axes[]    = {"x", "y", "z"};
      nlohmann::ordered_json reactions = nlohmann::ordered_json::object();
      for (std::size_t k = 0; k < loads.conditions.size(); ++k)
        if (loads.conditions[k].prescribes_displacement())
          for (int d = 0; d < dim; ++d)
            {
              const std::string &name = loads.conditions[k].name;
              history.add("reaction of " + name + " along " + axes[d] + " [N]", sums[k][d]);
              reactions[name].push_back(sums[k][d]);
              auto &largest = summary["largest_reactions"][name];
              if (largest.size() <= static_cast<std::size_t>(d))
                largest.push_back(sums[k][d]);
              else if (std::abs(sums[k][d]) > std::abs(largest[d].template get<double>()))
                largest[d] = sums[k][d];
            }
      summary["reactions"] = reactions;
    }

    /// What a load step that failed tells the user.
    std::string describe_failure(const SolverParameters &solver,
                                 const unsigned int      number,
                                 const double            time,
                                 const EquilibriumStep  &result,
                                 const GlobalIndex       n_broken)
    {
      const std::string broke_apart =
        "a body that broke apart under forces has no equilibrium: prescribe displacements instead, or take "
        "Solver/Name = ";
      return (solver.is_quasi_static() ? "Newton's method stopped in load step " :
                                         "dynamic relaxation stopped in load step ") +
             std::to_string(number) + ", t = " + short_number(time) + ", after " +
             std::to_string(result.iterations) + " iterations at a relative residual of " +
             short_number(result.residuals.back()) + ", not at " + short_number(solver.tolerance) +
             (result.problem.empty() ? "" : ", since " + result.problem) + ", with " +
             std::to_string(n_broken) + " broken bonds\n  advice: " +
             (solver.is_quasi_static() ?
                "raise Solver/Load steps, with loads that grow with t, or Solver/Newton iterations; see "
                "the residuals in history.h5; a body that buckles or softens may want Solver/Name = dynamic "
                "relaxation; " +
                  broke_apart + "dynamics" :
                "raise Solver/Maximum iterations; " + broke_apart + "dynamics");
    }
  } // namespace

  template <int dim>
  void Simulation<dim>::prepare_equilibria(const std::string &solver)
  {
    summary["solver"]["name"] = solver;
    {
      const Timings::Scope scope(timings, "setup");
      make_cracks_and_limits();
    }
    announce();
    check_loads();
    open_outputs();
  }

  template <int dim>
  void Simulation<dim>::make_bond_force()
  {
    if (parameters.checkpoints.restart)
      open_checkpoint();
    prepare_cracks();
    find_free_motions();
    weigh_bonds();
    prepare_comparisons();
    const Timings::Scope scope(timings, "setup");
    if (scene.correspondence)
      scene.force =
        std::make_unique<CorrespondenceForce<dim>>(scene.families, scene.correspondence, scene.laws);
    else
      scene.force = create_bond_force<dim>(*scene.weights);
  }

  template <int dim>
  void Simulation<dim>::run_relaxation()
  {
    make_bond_force();
    prepare_equilibria("dynamic relaxation");
    typename DynamicRelaxation<dim>::Controls controls;
    controls.tolerance      = parameters.solver.tolerance;
    controls.max_iterations = parameters.solver.max_iterations;
    controls.bonds_break    = can_break(parameters);
    DynamicRelaxation<dim> relaxation(*scene.force, *scene.system, scene.held, scene.loads, controls);
    run_load_steps(relaxation);
  }

  template <int dim>
  void Simulation<dim>::run_load_steps(EquilibriumPath<dim> &path)
  {
    if (scene.crack_tracker)
      scene.crack_tracker->start(scene.force->cut_share());
    if (parameters.comparison.fem && parameters.model.is_correspondence())
      set_up_nonlinear_fem();
    unsigned int done = 0;
    try
      {
        done = take_load_steps(path);
        warn_of_lost_thickness();
        warn_of_large_rotations();
        warn_of_loose_nodes(path.n_floating());
        if (scene.crack_tracker)
          scene.crack_tracker->write_paths(parameters.output_directory);
      }
    catch (const ComputationError &)
      {
        finish("failed");
        throw;
      }
    const bool reached_end = done == parameters.solver.load_steps;
    finish(reached_end ? "done" : "stopped");
    if (!reached_end)
      throw ComputationError(describe_stop("load step " + std::to_string(done)));
  }

  template <int dim>
  unsigned int Simulation<dim>::take_load_steps(EquilibriumPath<dim> &path)
  {
    const unsigned int last = parameters.solver.load_steps, interval = parameters.checkpoints.steps;
    const StopRequest  stop;
    unsigned int       number = resumed ? resumed->header.at("step").template get<unsigned int>() : 0;
    if (resumed)
      resume(path);
    while (number < last)
      {
        load_step(++number, path);
        const bool stops = stop.is_there(communicator);
        if (number < last && (stops || (interval > 0 && number % interval == 0)))
          save_checkpoint(number, path);
        if (stops)
          break;
      }
    return number;
  }

  template <int dim>
  EquilibriumStep
  Simulation<dim>::find_equilibrium(const unsigned int number, const double time, EquilibriumPath<dim> &path)
  {
    const Timings::Scope scope(timings, "solve");
    const std::string    what = "load step " + std::to_string(number) + " of " +
                             std::to_string(parameters.solver.load_steps) + ", " +
                             std::to_string(path.n_broken()) + " broken bonds";
    apply_loads(time);
    scene.null_space.project(external_force);
    ProgressLine progress(screen.get_stream(), screen.is_active(), what, parameters.solver.tolerance);
    return path.step(external_force, time, [&](const unsigned int iteration, const double r) {
      if (parameters.solver.is_quasi_static())
        screen << what << ": iteration " << iteration << ", residual " << short_number(r) << std::endl;
      else
        progress(iteration, r);
    });
  }

  template <int dim>
  void Simulation<dim>::load_step(const unsigned int number, EquilibriumPath<dim> &path)
  {
    const double end  = static_cast<double>(number) / parameters.solver.load_steps;
    double       time = static_cast<double>(number - 1) / parameters.solver.load_steps, part = end - time;
    summary["solver"]["steps"] = number;
    EquilibriumStep result;
    unsigned int    halvings = 0;
    // Whole at first; after a failure in halves, each of which may be halved again.
    while (time < end)
      {
        const double    next = std::min(end, time + part) > end - 1e-3 * part ? end : time + part;
        EquilibriumStep now  = find_equilibrium(number, next, path);
        now.add_before(result);
        result = now;
        if (result.converged)
          time = next;
        else if (halvings == parameters.solver.step_halvings || !parameters.solver.is_quasi_static())
          break;
        else
          {
            ++halvings;
            part *= 0.5;
            path.restore();
            screen << "load step " << number << " from t = " << short_number(time) << " is halved"
                   << std::endl;
          }
      }
    summary["solver"]["halvings"].push_back(halvings);
    displacement = path.displacement;
    store_displacement();
    if (scene.nonlinear_fem)
      solve_nonlinear_fem(end);
    record_equilibrium(number, result, path);
    if (!result.converged)
      throw ComputationError(
        describe_failure(parameters.solver, number, std::min(end, time + part), result, path.n_broken()));
    write_fields(number, end);
  }

  template <int dim>
  void Simulation<dim>::record_equilibrium(const unsigned int          number,
                                           const EquilibriumStep      &result,
                                           const EquilibriumPath<dim> &path)
  {
    const double time = static_cast<double>(number) / parameters.solver.load_steps;
    summary["solver"]["iterations"].push_back(result.iterations);
    summary["solver"]["converged"] = result.converged;
    history->add_series("residuals of step " + std::to_string(number), result.residuals);
    if (parameters.solver.is_quasi_static())
      {
        summary["solver"]["linear_iterations"].push_back(result.linear_iterations);
        summary["solver"]["residuals"].push_back(result.residuals);
      }

    const EnergyBudget &energy = path.energy();
    largest_energy             = std::max({largest_energy, std::abs(energy.external), energy.strain});
    const double drift         = largest_energy > 0 ? energy.imbalance() / largest_energy : 0.;
    history->add("step", number);
    history->add("time [s]", time);
    history->add("iterations", result.iterations);
    if (parameters.solver.is_quasi_static())
      history->add("linear iterations", result.linear_iterations);
    history->add("residual [-]", result.residuals.back());
    history->add("strain energy [J]", energy.strain);
    history->add("dissipated energy [J]", energy.dissipated);
    history->add("external work [J]", energy.external);
    history->add("drift [-]", drift);
    history->add("broken bonds", path.n_broken());
    auto reactions = scene.held.sum_by_condition(path.reaction(), communicator);
    if (scene.face_values && !by_nodes())
      {
        const auto at_faces = scene.face_values->sum_by_condition(path.face_reaction(), communicator);
        for (std::size_t k = 0; k < reactions.size(); ++k)
          reactions[k] += at_faces[k];
      }
    record_reactions<dim>(scene.loads, reactions, *history, summary);
    summary["displacements"] = record_displacements(scene, time, *history);
    if (scene.crack_tracker)
      {
        scene.crack_tracker->update(time, total_damage());
        record_crack_tips(path.n_broken(), time);
        summary["cracks"] = scene.crack_tracker->describe();
      }
    if (scene.areal_forces)
      summary["areal_force_densities"] = record_areal_forces(scene, parameters, *history);
    if (scene.gauges)
      record_gauges(*scene.gauges, displacement, *history, &summary["gauges"]);
    if (scene.nonlinear_fem)
      record_nonlinear_fem();
    history->end_row();
    summary["energy"] = {{"strain", energy.strain},
                         {"dissipated", energy.dissipated},
                         {"external", energy.external},
                         {"drift", drift}};
    if (!can_break(parameters))
      return;
    if (result.broken > 0 && !summary["damage"].contains("first_break_time"))
      summary["damage"]["first_break_time"] = time;
    summary["damage"]["broken_bonds"]   = path.n_broken();
    summary["damage"]["floating_nodes"] = path.n_floating();
    if (result.broken > 0 || !summary["damage"].contains("fragments"))
      summary["damage"]["fragments"] = find_fragments(*scene.families,
                                                      scene.force->bond_list(),
                                                      scene.nodes->spacing,
                                                      total_damage(),
                                                      parameters.cracks.damage);
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
