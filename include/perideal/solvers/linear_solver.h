// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_linear_solver_h
#define perideal_solvers_linear_solver_h

#include <perideal/boundary/surface_nodes.h>
#include <perideal/fem/elastic_fem.h>
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
  /// @param fem the assembled Q1 problem on the chosen mesh where the auxiliary space needs it,
  ///   else a null pointer
  /// @param surface the system's nodes on faces, or a null pointer where it has none
  template <int dim>
  std::unique_ptr<LinearSolver<dim>> create_linear_solver(const SolverParameters         &parameters,
                                                          const PreconditionerChoice     &choice,
                                                          const ConstrainedOperator<dim> &system,
                                                          const NullSpace<dim>           &null_space,
                                                          const Nodes<dim>               &nodes,
                                                          const std::shared_ptr<const ElasticFem<dim>> &fem,
                                                          const SurfaceNodes<dim> *surface = nullptr);
} // namespace perideal

#endif
