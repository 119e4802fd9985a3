// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/create_drivers.h>

namespace perideal
{
  template <int dim>
  std::unique_ptr<Driver<dim>> create_driver(Problem<dim> &problem)
  {
    const SolverParameters &solver = problem.parameters.solver;
    if (solver.is_dynamic())
      return create_dynamics_driver(problem);
    if (solver.is_nonlinear_static())
      return create_equilibrium_driver(problem);
    return create_static_driver(problem);
  }

  PERIDEAL_INSTANTIATE(create_driver)
} // namespace perideal
