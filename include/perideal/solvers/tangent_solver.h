// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_tangent_solver_h
#define perideal_solvers_tangent_solver_h

#include <perideal/output/lasting_state.h>
#include <perideal/solvers/linear_solver.h>

#include <functional>
#include <memory>
#include <string>

namespace perideal
{
  /**
   * Solves with a system that changes a little from solve to solve, as tangents do. The preconditioner is
   * made at first, and is to be made again when the iterations for a digit have doubled since; the assembled
   * solvers are made for every solve. Where CG was chosen by itself and fails, since the system is not
   * positive definite, GMRES is tried.
   */
  template <int dim>
  class TangentSolver
  {
  public:
    /// The solver of the parameters ("automatic", "cg", ...) for the system as it is. Collective.
    using Create = std::function<std::unique_ptr<LinearSolver<dim>>(const SolverParameters &)>;

    /// @throws what @p create does. Collective.
    TangentSolver(const SolverParameters &parameters, const Create &create);

    /// @param solution start and result; a failed solve is reported, not thrown. Collective.
    /// @param tolerance residual over the first residual
    /// @param descends whether a step is wanted along which the energy falls (LinearSolver::set_descent())
    LinearSolve solve(NodalVector       &solution,
                      const NodalVector &source,
                      const double       tolerance,
                      const bool         descends = false);

    /// Whether solves have become slow, so that the preconditioner is to be made anew.
    bool has_slowed() const { return is_slow && !parameters.assembles(); }
    /// Makes the preconditioner for the system as it is, which is to be positive definite. Collective.
    void renew();

    /// Whether the solver that was asked for takes symmetric systems alone.
    bool needs_symmetry() const { return parameters.takes_cg(); }

    std::string name() const { return solver->name(); }

    /// Before a load step: a preconditioner that is not the first one is made anew, so that the step depends
    /// on nothing but the equilibrium where it starts. A run that goes on from there knows no other.
    void start_step() { is_slow = is_slow || !is_first; }

    /// Registers what the next step needs to know of earlier solves.
    void register_state(LastingState &state);

  private:
    /// Makes the solver for the present system; where that cannot be, one that there is stays.
    bool renew(std::unique_ptr<LinearSolver<dim>> &solver, const SolverParameters &parameters) const;

    const SolverParameters             parameters;
    const Create                       create;
    std::unique_ptr<LinearSolver<dim>> solver;
    /// Whether the solver is the one of the beginning, has not solved yet, or has become slow.
    bool is_first = true, is_new = true, is_slow = false;
    /// Iterations a digit after the last set-up.
    double cost_when_new = 0;
  };
} // namespace perideal

#endif
