// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/load_steps.h>
#include <perideal/output/progress.h>
#include <perideal/output/summary.h>

#include <algorithm>
#include <utility>

namespace perideal
{
  template <int dim>
  LoadSteps<dim>::LoadSteps(Problem<dim> &problem, EquilibriumPath<dim> &path)
    : solver(problem.parameters.solver)
    , problem(problem)
    , path(path)
    , heating(problem)
  {
    heating.begin_cold();
  }

  template <int dim>
  EquilibriumStep
  LoadSteps<dim>::next(const std::uint64_t number, unsigned int &n_halvings, const Progress &progress)
  {
    const double    end    = end_of(number);
    double          part   = end - end_of(number - 1);
    EquilibriumStep result = unfinished.search;
    n_halvings             = unfinished.n_halvings;
    // Where the mesh changed at the end of a step, bonds are still to be judged there.
    do
      {
        const double    from = reached;
        const double    to   = std::min(end, from + part) > end - 1e-3 * part ? end : from + part;
        EquilibriumStep now  = find_equilibrium(number, to, progress);
        now.add_before(result);
        result = now;
        if (result.wants_mesh)
          {
            const bool broke = path.n_broken() > unfinished.n_broken;
            unfinished       = {result, n_halvings, broke ? 1 : unfinished.n_changes + 1, path.n_broken()};
            return result;
          }
        if (result.converged)
          continue;
        if (n_halvings == solver.step_halvings || !solver.is_quasi_static())
          return result;
        ++n_halvings;
        part *= 0.5;
        reached = from;
        path.restore();
        heating.go_back(path.displacement);
        problem.run.screen << "load step " << number << " from t = " << short_number(from) << " is halved"
                           << std::endl;
      }
    while (reached < end);
    unfinished = {};
    return result;
  }

  template <int dim>
  EquilibriumStep
  LoadSteps<dim>::find_equilibrium(const std::uint64_t number, const double to, const Progress &progress)
  {
    EquilibriumStep result;
    unsigned int    version = 0;
    do
      {
        version             = problem.force->version();
        EquilibriumStep now = approach(number, to, progress);
        now.add_before(result);
        result = now;
      }
    while (result.converged && !result.wants_mesh && problem.force->version() != version);
    return result;
  }

  template <int dim>
  EquilibriumStep
  LoadSteps<dim>::approach(const std::uint64_t number, const double to, const Progress &progress)
  {
    const std::string what = "load step " + std::to_string(number) + " of " +
                             std::to_string(solver.n_load_steps()) + ", " + std::to_string(path.n_broken()) +
                             " broken bonds";
    const double from = std::exchange(reached, to);
    heating.remember();
    problem.apply_loads(to);
    problem.free_motions.project(problem.state.external_force);
    heating.take_loads();
    EquilibriumStep result =
      path.step(problem.state.external_force, to, [&](const unsigned int iteration, const double r) {
        progress(what, from + (to - from) * share_of_iteration(r, solver.tolerance), iteration, r);
      });
    if (result.converged)
      work_of_heating += heating.work();
    return result;
  }

  template <int dim>
  void LoadSteps<dim>::register_state(LastingState &state)
  {
    if (problem.loading.expansion)
      state.add_value("work of heating", work_of_heating);
    state.add_value(
      "unfinished load step",
      [this] {
        const EquilibriumStep &search = unfinished.search;
        return LastingState::Json{{"iterations", search.iterations},
                                  {"linear iterations", search.linear_iterations},
                                  {"broken", search.broken},
                                  {"residuals", search.residuals},
                                  {"halvings", unfinished.n_halvings},
                                  {"changes of the mesh", unfinished.n_changes},
                                  {"broken bonds", unfinished.n_broken}};
      },
      [this](const LastingState::Json &read) {
        read.at("iterations").get_to(unfinished.search.iterations);
        read.at("linear iterations").get_to(unfinished.search.linear_iterations);
        read.at("broken").get_to(unfinished.search.broken);
        read.at("residuals").get_to(unfinished.search.residuals);
        read.at("halvings").get_to(unfinished.n_halvings);
        read.at("changes of the mesh").get_to(unfinished.n_changes);
        read.at("broken bonds").get_to(unfinished.n_broken);
      });
  }

  PERIDEAL_INSTANTIATE_CLASS(LoadSteps)
} // namespace perideal
