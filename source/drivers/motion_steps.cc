// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/drivers/motion_steps.h>
#include <perideal/operators/force/cell_steps.h>
#include <perideal/operators/system/stable_time_step.h>
#include <perideal/output/summary.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Of the shortest steps these would take weeks.
    constexpr double most_steps = 1e11;
  } // namespace

  void
  MotionSteps::choose(const SolverParameters &solver, const double stable_step, const std::string &of_damping)
  {
    stable   = stable_step;
    n_levels = 1 + static_cast<unsigned int>(std::lround(std::log2(solver.local_step_ratio)));
    if (!std::isfinite(stable))
      throw InputError("every node is held: nothing is left that could move")
        .parameter("Boundary conditions")
        .hint("hold less of the body, or take smaller cells, of which a boundary holds fewer");
    if (!(stable > 0))
      throw InputError("the damping leaves no time step that is stable")
        .parameter(of_damping)
        .hint("a motion of frequency f [1/s] is damped critically by 4 pi f");
    const double wanted   = solver.time_step > 0 ?
                              solver.time_step :
                              LocalSteps::ratio(n_levels - 1) * solver.time_step_safety * stable;
    const double n_wanted = std::max(1., std::ceil(solver.end_time / wanted - 1e-9));
    if (!(n_wanted <= most_steps))
      throw InputError("the run would take " + short_number(n_wanted) + " steps of " + short_number(wanted) +
                       " s; the largest stable step is " + short_number(stable) + " s")
        .parameter(solver.time_step > 0 && solver.time_step < 1e-3 * stable ? "Solver/Time step" :
                                                                              "Solver/End time")
        .allowed("what makes 1e11 steps at most")
        .hint("look at Solver/End time and Solver/Time step [s], Material/Density [kg/m^3] and Young "
              "modulus [Pa], "
              "and at the size of the body [m]");
    take(solver, solver.end_time / n_wanted);
  }

  void MotionSteps::resume(const SolverParameters &solver, const double earlier)
  {
    is_resumed = true;
    take(solver, earlier);
  }

  void MotionSteps::take(const SolverParameters &solver, const double step)
  {
    size   = step;
    number = std::ceil(solver.end_time / size - 1e-6);
  }

  std::string MotionSteps::divide(const SolverParameters &solver)
  {
    if (solver.time_step > 0 || shortest() <= stable)
      return "";
    while (shortest() / parts > solver.time_step_safety * stable)
      parts *= 2;
    take(solver, size / parts);
    return "the changed mesh is stable with shorter steps only: from here on they are " + short_number(size) +
           " s. Where cells failed before they were small, take a larger Adaptation/Reach or a smaller "
           "Interval";
  }

  template <int dim>
  void MotionSteps::choose_levels(const Problem<dim>                                     &problem,
                                  const std::function<double(const std::vector<bool> &)> &stable_of)
  {
    const SolverParameters &solver = problem.parameters.solver;
    for (unsigned int trials = 1; n_levels > 1; ++trials)
      {
        const LocalStepLevels chosen = local_step_levels<dim>(
          *problem.system,
          [&](const dealii::types::material_id id) { return problem.body.density_of(id); },
          stable_of,
          shortest(),
          solver.time_step_safety,
          n_levels);
        levels = chosen.of_nodes;
        if (is_resumed || solver.time_step > 0 || chosen.shortening == 1. || trials == n_levels)
          return;
        take(solver, solver.end_time / std::ceil(solver.end_time * chosen.shortening / size));
      }
  }

  template <int dim>
  void MotionSteps::make_local(Problem<dim> &problem)
  {
    if (n_levels == 1)
      return;
    const auto &moments  = problem.discretisation.gradients.moments;
    const auto &families = *problem.discretisation.families;
    const auto &bonds    = problem.force->bond_list();
    if (moments)
      local = std::make_shared<const CellSteps>(*moments, families, bonds, levels, n_levels);
    else
      local = std::make_shared<const LocalSteps>(families, bonds, levels, n_levels);
    levels.clear();
    // A mesh that adapts will have smaller cells.
    if (local->any_up_to(n_levels - 2) && local->n_families().back() == 0)
      problem.run.warn("no cell takes steps as long as Solver/Local step ratio = " +
                       std::to_string(problem.parameters.solver.local_step_ratio) +
                       " allows: a smaller one takes as much time");
  }

  nlohmann::ordered_json MotionSteps::figures() const
  {
    auto families = nlohmann::ordered_json::array();
    for (const GlobalIndex n : local->n_families())
      families.push_back(n);
    return {{"shortest_step", shortest()},
            {"families_by_level", families},
            {"share_of_cell_steps", local->share_of_cell_steps()}};
  }

  template void MotionSteps::choose_levels(const Problem<2> &,
                                           const std::function<double(const std::vector<bool> &)> &);
  template void MotionSteps::choose_levels(const Problem<3> &,
                                           const std::function<double(const std::vector<bool> &)> &);
  template void MotionSteps::make_local(Problem<2> &);
  template void MotionSteps::make_local(Problem<3> &);
} // namespace perideal
