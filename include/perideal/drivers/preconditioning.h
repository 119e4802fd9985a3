// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_preconditioning_h
#define perideal_drivers_preconditioning_h

#include <perideal/problem/problem.h>
#include <perideal/solvers/linear_solver.h>

#include <memory>

namespace perideal
{
  /// How the linear systems of a problem are preconditioned, and the finite elements that this takes.
  template <int dim>
  class Preconditioning
  {
  public:
    /// Chooses for a number of solves, and assembles what that needs. Collective.
    /// @param report part "solver" of summary.json, which is told the choice
    Preconditioning(const Problem<dim> &problem, const unsigned int n_solves, nlohmann::ordered_json &report);

    /// Makes a solver for a system of the problem. Collective.
    std::unique_ptr<LinearSolver<dim>> create_solver(const SolverParameters         &parameters,
                                                     const ConstrainedOperator<dim> &system) const;

    /// Takes finite elements of the body as the last forces found it, for solvers to come: bodies that turn
    /// far are another body to a preconditioner at rest. For isotropic solids of a law, on the mesh itself;
    /// else it does nothing. Collective.
    void follow_deformation();

  private:
    /// Along which faces the finite elements are to open; empty: none.
    typename SplitVertices<dim>::AreApart precracks() const;

    const Problem<dim>              &problem;
    PreconditionerChoice             choice;
    std::shared_ptr<ElasticFem<dim>> fem;
  };
} // namespace perideal

#endif
