// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_failed_step_h
#define perideal_drivers_failed_step_h

#include <perideal/solvers/equilibrium_path.h>
#include <perideal/solvers/solver_parameters.h>

#include <string>

namespace perideal
{
  /// Says how the search for the equilibrium of a load step ended, and what the user can do.
  /// @param time of the equilibrium that was sought
  std::string describe_failed_step(const SolverParameters &solver,
                                   const unsigned int      number,
                                   const double            time,
                                   const EquilibriumStep  &result,
                                   const GlobalIndex       n_broken);
} // namespace perideal

#endif
