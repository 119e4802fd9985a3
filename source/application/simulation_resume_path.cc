// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/base/instantiate.h>

#include <limits>

// Simulation: load steps of nonlinear equilibria are stopped and go on.

namespace perideal
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    /// Parts of the summary that load steps add to, those of "solver" apart.
    constexpr const char *grown[]           = {"largest_reactions", "gauges"};
    constexpr const char *grown_of_solver[] = {"halvings", "iterations", "linear_iterations", "residuals"};

    /// Those members of an object that are there.
    template <std::size_t n>
    Json select(const Json &object, const char *const (&names)[n])
    {
      Json result = Json::object();
      for (const char *name : names)
        if (object.contains(name))
          result[name] = object[name];
      return result;
    }

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
  void Simulation<dim>::save_checkpoint(const unsigned int number, const EquilibriumPath<dim> &path)
  {
    const Timings::Scope scope(timings, "output");
    Checkpoint           checkpoint =
      start_checkpoint(number, static_cast<double>(number) / parameters.solver.load_steps);
    checkpoint.header["summary"] = select(summary, grown);
    checkpoint.header["solver"]  = select(summary.at("solver"), grown_of_solver);
    checkpoint.header["series"]  = history->all_series();
    path.save(checkpoint);
    write(checkpoint);
  }

  template <int dim>
  void Simulation<dim>::resume(EquilibriumPath<dim> &path)
  {
    const Json        &header = resumed->header;
    const unsigned int number = header.at("step").template get<unsigned int>();
    const double       time   = header.at("time").template get<double>();
    resume_scene();
    apply_loads(time);
    scene.null_space.project(external_force);
    path.resume(*resumed, external_force, time);
    summary.update(header.at("summary"));
    summary["solver"].update(header.at("solver"));
    for (const auto &item : header.at("series").items())
      history->add_series(item.key(), to_numbers(item.value()));
    std::vector<double> times;
    for (unsigned int k = 1; k <= number; ++k)
      times.push_back(static_cast<double>(k) / parameters.solver.load_steps);
    // Finite elements leave no checkpoints: they take their steps again.
    if (scene.nonlinear_fem)
      for (const double t : times)
        solve_nonlinear_fem(t);
    field_output->resume(times);
    resumed.reset();
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
