// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/advice.h>
#include <perideal/application/areal_forces.h>
#include <perideal/application/boundary_stress.h>
#include <perideal/application/comparison.h>
#include <perideal/application/gauge_records.h>
#include <perideal/application/output_fields.h>
#include <perideal/application/prescribed_displacements.h>
#include <perideal/application/report.h>
#include <perideal/application/simulation.h>
#include <perideal/application/versions.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/post/mirror_reactions.h>
#include <perideal/output/files.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  template <int dim>
  Simulation<dim>::Simulation(const SceneParameters &parameters,
                              const RunContext      &context,
                              MPI_Comm               communicator)
    : parameters(parameters)
    , context(context)
    , communicator(communicator)
    , screen(std::cout, dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , timings(communicator)
  {
  }

  template <int dim>
  void Simulation<dim>::run()
  {
    create_output_directory(parameters.output_directory, communicator);
    make_mesh();
    make_nodes_and_families();
    if (parameters.solver.is_dynamic())
      {
        run_dynamics();
        return;
      }
    if (parameters.solver.is_relaxation())
      {
        run_relaxation();
        return;
      }
    if (parameters.solver.is_quasi_static())
      {
        run_quasi_static();
        return;
      }
    find_free_motions();
    weigh_bonds();
    prepare_comparisons();
    set_up_solver();
    announce();
    check_loads();
    open_outputs();
    try
      {
        for (unsigned int number = 1; number <= parameters.solver.load_steps; ++number)
          step(number);
      }
    catch (const ComputationError &)
      {
        finish("failed");
        throw;
      }
    finish("done");
  }

  template <int dim>
  void Simulation<dim>::announce(const std::string &more)
  {
    screen << banner(parameters, scene) << more << std::flush;
    for (const std::string &warning : warnings(parameters, scene))
      screen << "warning     " << warning << std::endl;
  }

  template <int dim>
  void Simulation<dim>::open_outputs()
  {
    const bool is_series = parameters.solver.is_dynamic() || parameters.solver.load_steps > 1;
    // Dynamics have moved on to their step, load steps have recorded theirs.
    const double last_row = parameters.solver.is_dynamic() ? -0.5 : 0.5;
    history =
      std::make_unique<History>(parameters.output_directory,
                                communicator,
                                resumed ? resumed->header.at("step").template get<double>() + last_row : -1.);
    field_output = std::make_unique<FieldOutput<dim>>(*scene.mesh,
                                                      *scene.nodes,
                                                      parameters.output_directory,
                                                      is_series ? OutputSteps::series : OutputSteps::single);
  }

  template <int dim>
  void Simulation<dim>::step(const unsigned int number)
  {
    const double time          = static_cast<double>(number) / parameters.solver.load_steps;
    summary["solver"]["steps"] = number;
    solve_equilibrium(time);
    record_step(number, time);
    write_fields(number, time);
  }

  template <int dim>
  void Simulation<dim>::solve_equilibrium(const double time)
  {
    const Timings::Scope scope(timings, "solve");
    apply_loads(time);

    NodalVector residual, correction;
    scene.system->initialize(residual);
    scene.system->initialize(correction);
    scene.system->residual(residual, external_force, displacement);
    scene.null_space.project(residual);

    ProgressLine      progress(std::cout,
                          dealii::Utilities::MPI::this_mpi_process(communicator) == 0,
                          "solving t = " + short_number(time),
                          parameters.solver.tolerance);
    const LinearSolve result = scene.linear_solver->solve(
      correction, residual, [&](const unsigned int iteration, const double r) { progress(iteration, r); });
    displacement += correction;
    summary["solver"]["iterations"].push_back(result.iterations);
    summary["solver"]["converged"] = result.converged;
    history->add_series("residuals of step " + std::to_string(summary["solver"]["iterations"].size()),
                        result.residuals);
    summary["solver"]["residuals"].push_back(result.residuals);
    store_displacement();
    if (!result.converged)
      throw ComputationError(
        "the linear solver (" + scene.linear_solver->name() + ") stopped at t = " + short_number(time) +
        " after " + std::to_string(result.iterations) + " iterations at a relative residual of " +
        short_number(result.residuals.back()) + ", not at " + short_number(parameters.solver.tolerance) +
        "\n  advice: see the residuals in history.h5; raise Solver/Maximum iterations, enlarge Nodes/Horizon "
        "factor, take "
        "another Solver/Preconditioner, or check the scene with --check");
  }

  template <int dim>
  void Simulation<dim>::store_displacement()
  {
    scene.displacement.resize(scene.nodes->size());
    for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
      for (int d = 0; d < dim; ++d)
        scene.displacement[i][d] = displacement.local_element(dim * i + d);
    scene.null_space.remove_mean(*scene.nodes, scene.displacement);
  }

  template <int dim>
  void Simulation<dim>::record_step(const unsigned int number, const double time)
  {
    NodalVector internal_force, free_force;
    scene.system->initialize_all(internal_force);
    scene.system->initialize(free_force);
    scene.system->internal_force(internal_force, displacement);
    std::copy(
      internal_force.begin(), internal_force.begin() + free_force.locally_owned_size(), free_force.begin());

    // Linear: the strain energy is half the work of all forces that act on the body.
    auto from_faces = sum_mirror_reactions(*scene.system, scene.loads.conditions.size());
    if (parameters.model.is_consistent() && !by_nodes())
      {
        const auto forces = scene.bonds->support_forces();
        from_faces.force  = scene.face_values->sum_by_condition(forces, communicator);
        from_faces.work   = scene.face_values->work(forces, communicator);
      }
    double strain_energy = 0.5 * (free_force * displacement + from_faces.work);
    free_force -= external_force;
    const auto held_reactions = scene.held.sum_by_condition(free_force, communicator);
    double     external_work  = 0.5 * (external_force * displacement +
                                  scene.held.work(free_force, displacement, communicator) + from_faces.work);
    if (scene.ghosts)
      {
        const GhostBalance balance = balance_of_ghosts(time);
        strain_energy              = balance.strain_energy;
        external_work              = balance.external_work;
        from_faces.force           = balance.reactions;
      }

    history->add("step", number);
    history->add("time [s]", time);
    history->add("strain energy [J]", strain_energy);
    history->add("external work [J]", external_work);
    const char *axes[]    = {"x", "y", "z"};
    Json        reactions = Json::object();
    for (std::size_t k = 0; k < scene.loads.conditions.size(); ++k)
      if (scene.loads.conditions[k].prescribes_displacement())
        for (int d = 0; d < dim; ++d)
          {
            const std::string &name  = scene.loads.conditions[k].name;
            const double       value = by_nodes() ? held_reactions[k][d] : from_faces.force[k][d];
            history->add("reaction of " + name + " along " + axes[d] + " [N]", value);
            reactions[name].push_back(value);
          }
    summary["displacements"] = record_displacements(scene, time, *history);
    if (scene.areal_forces)
      summary["areal_force_densities"] = record_areal_forces(scene, parameters, *history);
    if (scene.gauges)
      record_gauges(*scene.gauges, displacement, *history, &summary["gauges"]);
    history->end_row();
    const double drift   = external_work != 0 ? (external_work - strain_energy) / external_work : 0.;
    summary["energy"]    = {{"strain", strain_energy}, {"external", external_work}, {"drift", drift}};
    summary["reactions"] = reactions;
  }

  template <int dim>
  void Simulation<dim>::write_fields(const unsigned int number, const double time)
  {
    const bool is_last = number == parameters.solver.load_steps;
    if (is_last)
      {
        compare_at_end(time);
        if (external_force.l2_norm() > 0)
          summary["loads"] = load_resultants(time);
      }
    const Timings::Scope scope(timings, "output");
    add_output_fields(scene, parameters.field_names(), *field_output);
    field_output->write(number, time);
    if (is_last && !parameters.boundary_stress.empty())
      summary["boundary_stress"] = write_boundary_stress(scene, parameters, time);
  }

  template <int dim>
  void Simulation<dim>::compare_at_end(const double time)
  {
    if (scene.nonlinear_fem)
      scene.comparisons["fem"] = nonlinear_fem_at_nodes(scene);
    else if (parameters.comparison.fem)
      scene.comparisons["fem"] = solve_fem(scene,
                                           compared_solids_on(*scene.mesh),
                                           time,
                                           parameters.solver.tolerance,
                                           parameters.comparison.fem_degree,
                                           timings,
                                           summary["fem"]);
    if (parameters.comparison.has_exact())
      scene.comparisons["exact"] = evaluate_exact(scene, parameters.comparison, time);
    const Timings::Scope scope(timings, "output");
    summary["errors"] = compare(scene, parameters.comparison, parameters.output_directory);
  }

  template <int dim>
  void Simulation<dim>::finish(const std::string &status)
  {
    {
      const Timings::Scope scope(timings, "output");
      const bool           dynamic = parameters.solver.is_dynamic();
      if (status != "done" &&
          (dynamic ? motion_time > frame_time :
                     status == "failed" && scene.displacement.size() == scene.nodes->size()))
        {
          // What there is may show what went wrong.
          field_output->add_vector("displacement", scene.displacement);
          field_output->write(dynamic ? parameters.frames + 1 : parameters.solver.load_steps + 1,
                              dynamic ? motion_time : 2.);
        }
      history->finish();
    }
    Json result          = {{"status", status}, {"command", context.command}};
    result["versions"]   = versions();
    result["parameters"] = context.parameters;
    result.update(describe_discretisation(parameters, scene));
    result.update(summary);
    result["skipped"]        = list_skipped(parameters, scene);
    const auto seconds       = timings.seconds();
    result["seconds"]        = seconds;
    result["memory_bytes"]   = peak_memory_bytes(communicator);
    result["operator_bytes"] = dealii::Utilities::MPI::sum(
      scene.families->memory_consumption() +
        (scene.force ? scene.force->memory_consumption() : scene.bonds->memory_consumption()) +
        (scene.tangent ? scene.tangent->memory_consumption() : 0) +
        (scene.contact ? scene.contact->memory_consumption() : 0),
      communicator);
    result["ranks"] = dealii::Utilities::MPI::n_mpi_processes(communicator);
    write_summary(parameters.output_directory + "/summary.json", result, communicator);

    if (status == "done" && !parameters.solver.is_dynamic())
      screen << "solved      " << summary["solver"]["iterations"].back() << " iterations, strain energy "
             << short_number(summary["energy"]["strain"].template get<double>()) << " J\n"
             << describe_boundary_stress(summary["boundary_stress"]);
    if (status == "done" && summary.contains("loads"))
      screen << describe_loads(summary["loads"]);
    if (status == "done" && parameters.solver.is_dynamic())
      screen << describe_motion(summary);
    if (parameters.solver.is_nonlinear_static())
      screen << describe_damage(summary, "");
    if (status == "done" && scene.areal_forces)
      screen << describe_areal_forces(summary["areal_force_densities"]);
    if (result.contains("errors") && !result["errors"].empty())
      screen << '\n' << error_table(result["errors"]);
    screen << '\n' << timing_table(seconds) << "\nresults in " << parameters.output_directory << std::endl;
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)
} // namespace perideal
