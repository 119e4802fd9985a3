// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/versions.h>
#include <perideal/output/files.h>
#include <perideal/output/pictures.h>
#include <perideal/output/summary.h>
#include <perideal/problem/description.h>
#include <perideal/problem/output_fields.h>
#include <perideal/problem/vertex_displacement.h>
#include <perideal/recorders/recorders.h>
#include <perideal/recorders/report.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  template <int dim>
  Recorders<dim>::Recorders(Problem<dim> &problem, const RunKind &kind)
    : problem(problem)
    , kind(kind)
    , recorders(make_recorders(problem, kind))
  {
  }

  template <int dim>
  void Recorders<dim>::open(const double last_row, const Checkpoint *resumed)
  {
    const SceneParameters       &parameters = problem.parameters;
    const bool                   is_series  = kind.has_motion || parameters.solver.n_load_steps() > 1;
    std::optional<std::uint32_t> checksum;
    if (resumed != nullptr)
      checksum = resumed->get<std::uint32_t>("history");
    history =
      std::make_unique<History>(parameters.output_directory, problem.run.communicator, last_row, checksum);
    if (!history->warning().empty())
      problem.run.warn(history->warning());
    fields = std::make_unique<FieldOutput<dim>>(*problem.body.mesh,
                                                *problem.body.nodes,
                                                make_mesh_points(problem),
                                                parameters.output_directory,
                                                is_series ? OutputSteps::series : OutputSteps::single,
                                                parameters.format);
    for (auto &recorder : recorders)
      recorder->start(result);
    register_state(problem.lasting);
  }

  template <int dim>
  void Recorders<dim>::observe(const Step<dim> &step)
  {
    for (auto &recorder : recorders)
      recorder->observe(step, {*history, result});
  }

  template <int dim>
  void Recorders<dim>::record(const Step<dim> &step)
  {
    history->add("step", step.number);
    history->add("time [s]", step.time);
    for (auto &recorder : recorders)
      recorder->record(step, {*history, result});
    write_together(problem.run.communicator, [&] { history->end_row(); });
    last_time = step.time;
  }

  template <int dim>
  void Recorders<dim>::write_fields(const Step<dim> &step)
  {
    if (!kind.has_motion && !step.is_last && !problem.parameters.has_frame(step.number))
      return;
    const Timings::Scope scope(problem.run.timings, "output");
    for (auto &recorder : recorders)
      recorder->prepare_fields(step);
    add_output_fields(problem, problem.parameters.field_names(), *fields);
    frame_times.push_back(step.time);
    fields->write(frame_times.size(), step.time);
  }

  template <int dim>
  void Recorders<dim>::conclude(const Step<dim> &step)
  {
    for (auto &recorder : recorders)
      recorder->conclude(step, {*history, result});
  }

  template <int dim>
  void Recorders<dim>::write_last_fields()
  {
    const bool        is_new = frame_times.empty() || last_time > frame_times.back();
    const State<dim> &state  = problem.state;
    if (!is_new || state.displacement.size() != problem.body.nodes->size())
      return;
    const SceneParameters &parameters = problem.parameters;
    add_output_fields(problem, {"displacement"}, *fields);
    // What failed stands behind all load steps.
    const unsigned int n_steps = parameters.solver.n_load_steps();
    fields->write((kind.has_motion ? parameters.frames : n_steps) + 1,
                  kind.has_motion ? last_time :
                                    1. + static_cast<double>(n_steps) / parameters.solver.load_steps);
  }

  namespace
  {
    template <int dim>
    double largest_displacement(const Problem<dim> &problem)
    {
      double largest = 0;
      for (const auto &displacement : problem.state.displacement)
        largest = std::max(largest, displacement.norm());
      return dealii::Utilities::MPI::max(largest, problem.run.communicator);
    }
  } // namespace

  template <int dim>
  void Recorders<dim>::finish(const RunReport &report)
  {
    Run              &run    = problem.run;
    const char *const name[] = {"done", "stopped", "failed"};
    const bool        done   = report.status == RunStatus::done;
    {
      const Timings::Scope scope(run.timings, "output");
      if (report.status == RunStatus::failed || (kind.has_motion && !done))
        write_last_fields();
      for (auto &recorder : recorders)
        recorder->finish(result);
      write_together(run.communicator, [&] { history->finish(); });
    }
    Json summary            = {{"status", name[static_cast<unsigned int>(report.status)]},
                               {"command", run.context.command}};
    summary["versions"]     = versions();
    summary["parameters"]   = run.context.parameters;
    summary["changed_from"] = run.context.changed_from;
    summary["warnings"]     = run.warnings;
    summary.update(describe_discretisation(problem));
    if (!run.adaptation.empty())
      summary["adaptation"] = run.adaptation;
    summary.update(result);
    summary["skipped"] = list_skipped(problem);
    summary["skipped"].update(report.skipped);
    const auto seconds        = run.timings.seconds();
    summary["seconds"]        = seconds;
    summary["memory_bytes"]   = peak_memory_bytes(run.communicator);
    summary["operator_bytes"] = dealii::Utilities::MPI::sum(report.operator_bytes, run.communicator);
    summary["ranks"]          = dealii::Utilities::MPI::n_mpi_processes(run.communicator);
    write_summary(problem.parameters.output_directory + "/summary.json", summary, run.communicator, done);

    for (const auto &recorder : recorders)
      run.screen << recorder->describe(result, done);
    run.screen << "moved       by " << short_number(largest_displacement(problem)) << " m at most\n";
    run.screen << report.lines;
    if (summary.contains("errors") && !summary["errors"].empty())
      run.screen << '\n' << error_table(summary["errors"]);
    run.screen << '\n'
               << timing_table(seconds) << "\nresults in " << problem.parameters.output_directory
               << std::endl;
    if (problem.parameters.pictures.are_wanted() && run.screen.is_active())
      run.screen
        << "pictures    "
        << draw_pictures(problem.parameters.output_directory, problem.parameters.pictures).in_one_line()
        << std::endl;
  }

  template <int dim>
  void Recorders<dim>::abandon() noexcept
  {
    try
      {
        if (history)
          history->finish();
      }
    catch (const std::exception &)
      {
        // The error that ends the run is told; the rows of history.csv are on disk.
      }
  }

  namespace
  {
    /// JSON has null for what is no number, as attempts that failed may leave.
    std::vector<double> to_numbers(const Json &list)
    {
      std::vector<double> result;
      for (const Json &value : list)
        result.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
      return result;
    }
  } // namespace

  template <int dim>
  void Recorders<dim>::register_state(LastingState &state)
  {
    // Recorders::open() asks for it.
    state.add_value(
      "history", [this] { return Json(history->checksum()); }, [](const Json &) {});
    state.add_value(
      "series",
      [this] { return Json(history->all_series()); },
      [this](const Json &read) {
        for (const auto &item : read.items())
          history->add_series(item.key(), to_numbers(item.value()));
      });
    state.add_value(
      "frames",
      [this] { return Json(frame_times); },
      [this](const Json &read) {
        frame_times = read.get<std::vector<double>>();
        fields->resume(frame_times);
      });
    for (const auto &recorder : recorders)
      recorder->register_state(state, result);
  }

  PERIDEAL_INSTANTIATE_CLASS(Recorders)
} // namespace perideal
