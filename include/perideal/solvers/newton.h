// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_newton_h
#define perideal_solvers_newton_h

#include <perideal/operators/null_space.h>
#include <perideal/operators/tangent_operator.h>
#include <perideal/solvers/equilibrium_path.h>
#include <perideal/solvers/tangent_solver.h>

namespace perideal
{
  /**
   * Equilibrium by Newton-Raphson (PDBC Appendix B) with the tangent in closed form. Loads are dead. In
   * the first iteration of a step the held components move by their increments, and the free ones by the
   * linear prediction from where the last step ended.
   *
   * Linear systems are solved to a tenth of the relative residual of the equilibrium, at most to 1e-3, so
   * that the residual they leave goes with the square of it, below the one that Newton's method leaves
   * itself; no lower than a tenth of what the tolerance asks for.
   *
   * Line search along a step d with the residual r: the whole step is taken where it lowers |r|, or where
   * it halves |d.r|, the slope of the energy, which alone lets slender bodies bend far: their first steps
   * stretch them. Whole steps alone may take fewer iterations there, or end in an equilibrium far off.
   * Otherwise the step is shortened towards d.r = 0. Where d.r is not positive at the start, the tangent is
   * not positive definite there and |r| alone counts.
   *
   * The motions that a scene leaves free are taken from residuals and steps, as in statics: in their
   * direction, the balance is that of the undeformed body.
   *
   * KINSOL through deal.II 9.4 does not serve: in a release build it returned as from a solution when
   * SUNDIALS had given up (at the limit of iterations, and at its limit of the step, 1 by default for a body
   * that starts from rest), it stops by a maximum norm fixed at the beginning, where reactions change, and
   * its line search lowers |r| only, with every force computed twice.
   */
  template <int dim>
  class NewtonSolver : public EquilibriumPath<dim>
  {
  public:
    using typename EquilibriumPath<dim>::Controls;

    /// @param tangent of the force, the operator behind @p system and @p linear. The arguments must
    /// outlive this object. Collective.
    NewtonSolver(BondForce<dim>                 &bonds,
                 TangentOperator<dim>           &tangent,
                 const ConstrainedOperator<dim> &system,
                 TangentSolver<dim>             &linear,
                 const HeldNodes<dim>           &held,
                 const Loads<dim>               &loads,
                 const NullSpace<dim>           &null_space,
                 const Controls                 &controls);

    using EquilibriumPath<dim>::displacement;

  private:
    void                                 start_step(const double time) override;
    typename EquilibriumPath<dim>::Norms measure(const NodalVector &external) override;
    bool                                 is_in_place() const override { return in_place; }
    bool iterate(const NodalVector &external, EquilibriumStep &result) override;

    /// External and internal force of free components, motions that are free taken out.
    void   compute_residual(const NodalVector &external);
    double relative_tolerance() const;
    /// Moves along the step as far as it helps; false where nothing did. Collective.
    bool search(const NodalVector &external);

    using EquilibriumPath<dim>::force;
    using EquilibriumPath<dim>::held;

    TangentOperator<dim> &tangent;
    TangentSolver<dim>   &linear;
    const NullSpace<dim> &null_space;

    /// What held components have still to move.
    NodalVector                          held_increment;
    bool                                 in_place = true;
    NodalVector                          residual, correction, start, rest_stiffness;
    typename EquilibriumPath<dim>::Norms norms = {};
  };
} // namespace perideal

#endif
