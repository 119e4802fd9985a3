// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/solvers/tangent_solver.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  TangentSolver<dim>::TangentSolver(const SolverParameters &parameters, const Create &create)
    : parameters(parameters)
    , create(create)
    , solver(create(parameters))
  {
  }

  template <int dim>
  bool TangentSolver<dim>::renew(std::unique_ptr<LinearSolver<dim>> &target,
                                 const SolverParameters             &parameters) const
  {
    try
      {
        target = create(parameters);
        return true;
      }
    catch (const ComputationError &)
      {
        // A node that lost its bonds has no block to invert, in the whole body it had one.
        return false;
      }
  }

  template <int dim>
  void TangentSolver<dim>::renew()
  {
    is_new   = renew(solver, parameters);
    is_first = is_first && !is_new;
    is_slow  = false;
  }

  template <int dim>
  LinearSolve TangentSolver<dim>::solve(NodalVector       &solution,
                                        const NodalVector &source,
                                        const double       tolerance,
                                        const bool         descends)
  {
    if (parameters.assembles())
      renew();
    const NodalVector start(solution);
    solver->set_tolerance(tolerance);
    solver->set_descent(descends);
    LinearSolve result = solver->solve(solution, source, {});
    if (parameters.assembles())
      return result;
    if (!result.converged && parameters.linear_solver == LinearSolverName::automatic)
      {
        SolverParameters with_gmres = parameters;
        with_gmres.linear_solver    = LinearSolverName::gmres;
        std::unique_ptr<LinearSolver<dim>> gmres;
        if (!renew(gmres, with_gmres))
          return result;
        const unsigned int in_vain = result.iterations;
        solution                   = start;
        gmres->set_tolerance(tolerance);
        result = gmres->solve(solution, source, {});
        result.iterations += in_vain;
        return result;
      }
    // Few iterations say little.
    const double cost = std::max(result.iterations, 10u) / std::max(-std::log10(tolerance), 1.);
    if (is_new)
      cost_when_new = cost;
    is_new  = false;
    is_slow = cost > 2 * cost_when_new;
    return result;
  }

  template <int dim>
  void TangentSolver<dim>::register_state(LastingState &state)
  {
    state.add_value("linear solver is the first", is_first);
    state.add_value("linear solver is new", is_new);
    state.add_value("linear solver is slow", is_slow);
    state.add_value("linear solver's iterations a digit", cost_when_new);
  }

  PERIDEAL_INSTANTIATE_CLASS(TangentSolver)
} // namespace perideal
