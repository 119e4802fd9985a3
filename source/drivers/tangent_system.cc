// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/floating_nodes.h>
#include <perideal/drivers/tangent_system.h>

namespace perideal
{
  template <int dim>
  TangentSystem<dim>::TangentSystem(Problem<dim> &problem, nlohmann::ordered_json &report)
    : problem(problem)
    , tangent(problem.discretisation.create_tangent())
    , system(std::make_unique<ConstrainedOperator<dim>>(tangent,
                                                        problem.loading.supports->images(),
                                                        problem.loading.supports->unknowns(),
                                                        problem.loading.supports->held().mask()))
    // A load step takes about four solves.
    , preconditioning(
        std::make_unique<Preconditioning<dim>>(problem, 4 * problem.parameters.solver.load_steps, report))
  {
    solver =
      std::make_unique<TangentSolver<dim>>(problem.parameters.solver, [this](const SolverParameters &given) {
        if (solver)
          preconditioning->follow_deformation();
        return preconditioning->create_solver(given, *system);
      });
  }

  template <int dim>
  template <typename Solver, typename... First>
  std::unique_ptr<Solver> TangentSystem<dim>::create(const Controls &controls, const First &...first)
  {
    typename NewtonSolver<dim>::FindFloating find_floating;
    if (controls.bonds_break || !problem.failure.precracks.empty())
      find_floating = [this]() { return floating_nodes(problem); };
    const auto &supports = problem.loading.supports;
    return std::make_unique<Solver>(first...,
                                    *problem.force,
                                    *tangent,
                                    *system,
                                    *solver,
                                    supports->held(),
                                    problem.loading.loads,
                                    problem.free_motions,
                                    controls,
                                    supports->hold_nodes() ? nullptr : supports->face_values().get(),
                                    find_floating);
  }

  template <int dim>
  std::unique_ptr<NewtonSolver<dim>> TangentSystem<dim>::create_newton(const Controls &controls)
  {
    return create<NewtonSolver<dim>>(controls);
  }

  template <int dim>
  std::unique_ptr<ControlledNewton<dim>>
  TangentSystem<dim>::create_controlled_newton(const typename ControlledNewton<dim>::Control &control,
                                               const Controls                                &controls)
  {
    return create<ControlledNewton<dim>>(controls, control);
  }

  PERIDEAL_INSTANTIATE_CLASS(TangentSystem)
} // namespace perideal
