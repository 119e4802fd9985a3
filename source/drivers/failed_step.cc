// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/drivers/failed_step.h>
#include <perideal/output/progress.h>
#include <perideal/output/summary.h>

namespace perideal
{
  std::string describe_failed_step(const SolverParameters &solver,
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
} // namespace perideal
