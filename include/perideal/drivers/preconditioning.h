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

    /// Takes finite elements of the body as the last forces found it, for solvers to come, where it turned or
    /// strained far: it is another body then to a preconditioner at rest. For isotropic solids of a law, on
    /// the mesh itself; else it does nothing. Collective.
    void follow_deformation();

  private:
    /// Along which faces the finite elements are to open; empty: none.
    typename SplitVertices<dim>::AreApart precracks() const;

    std::shared_ptr<const AuxiliaryElements<dim>>
    make_elements(const std::shared_ptr<const ElasticFem<dim>> &fem) const;

    const Problem<dim>  &problem;
    PreconditionerChoice choice;
    /// Of the auxiliary space, where that was chosen: of the body at rest, and of that which solvers to come
    /// take.
    std::shared_ptr<const AuxiliaryElements<dim>> at_rest, elements;
  };
} // namespace perideal

#endif
