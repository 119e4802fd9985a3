// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_linear_solver_h
#define perideal_solvers_linear_solver_h

#include <perideal/operators/system/auxiliary_elements.h>
#include <perideal/operators/system/constrained_operator.h>
#include <perideal/operators/system/null_space.h>
#include <perideal/solvers/solver_parameters.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace perideal
{
  /// Holds the preconditioner that was chosen for a scene.
  struct PreconditionerChoice
  {
    PreconditionerName preconditioner = PreconditionerName::automatic;
    /// Of the auxiliary space.
    std::optional<AuxiliaryMesh> auxiliary_mesh;
    /// Why, for the banner, where the program chose; else empty.
    std::string reason;
  };

  /// Describes a linear solve.
  struct LinearSolve
  {
    unsigned int iterations = 0;
    bool         converged  = false;
    /// CG met a direction along which the operator is not positive: some motion sets energy free.
    bool indefinite = false;
    /// Residual norms over the first one, by iteration.
    std::vector<double> residuals;
  };

  /**
   * Solves the system of a linear static scene for many right-hand sides: operator and
   * preconditioner are set up once.
   */
  template <int dim>
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /// Called with the iteration and the relative residual.
    using Progress = std::function<void(const unsigned int, const double)>;

    /// solution is the start and the result. A failed solve is reported, not thrown.
    virtual LinearSolve solve(NodalVector &solution, const NodalVector &source, const Progress &progress) = 0;

    /// "cg" with its preconditioner and the like, for the banner.
    virtual std::string name() const = 0;

    /// Sets the residual over the first one at which later solves end.
    void set_tolerance(const double value) { tolerance = value; }
    /// Whether later solves, which start from zero, are to find a step along which the energy of the system
    /// falls: CG ends as converged before the first direction along which the operator is not positive.
    void set_descent(const bool value) { descends = value; }

  protected:
    explicit LinearSolver(const double tolerance)
      : tolerance(tolerance)
    {
    }

    double tolerance;
    bool   descends = false;
  };

  /// Chooses the solver: CG where the operator is symmetric, else GMRES, unless
  /// the parameters say otherwise; sets up its preconditioner. The arguments
  /// must outlive the result. Collective.
  /// @param choice as of choose_preconditioner()
  /// @param elements of the auxiliary space where that was chosen, else a null pointer
  template <int dim>
  std::unique_ptr<LinearSolver<dim>>
  create_linear_solver(const SolverParameters                              &parameters,
                       const PreconditionerChoice                          &choice,
                       const ConstrainedOperator<dim>                      &system,
                       const NullSpace<dim>                                &null_space,
                       const std::shared_ptr<const AuxiliaryElements<dim>> &elements);
} // namespace perideal

#endif
