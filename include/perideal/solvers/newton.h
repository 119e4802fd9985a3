// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_newton_h
#define perideal_solvers_newton_h

#include <perideal/operators/linear/tangent_operator.h>
#include <perideal/operators/system/null_space.h>
#include <perideal/solvers/equilibrium_path.h>
#include <perideal/solvers/tangent_solver.h>

namespace perideal
{
  /**
   * Finds equilibria by Newton-Raphson (PDBC Appendix B) with the tangent in closed form. Loads are dead
   * loads. In the first iteration of a step the held components move by their increments, and the free ones
   * by the linear prediction from where the last step ended. Where bonds soften, a step begins where its
   * part of the motion of the step before leads, if that is near an equilibrium: cracks mostly go on.
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
   * Where bonds soften, the tangent is that of bonds that go on to do so, as long as it leads on. Where it
   * does not, as when a crack jumps, an iteration seeks the equilibrium of the bonds as they have softened
   * until then and lets them soften further there, for good: that linear system is positive definite, and
   * what is left of bonds only falls. A step there is gone over again and again while the energy falls as
   * steeply, as it does where a crack runs away. The linear systems are solved to a tenth first, since bonds
   * that begin to soften or unload leave more than that, and then to what the last iteration left, squared
   * (Eisenstat and Walker, SIAM Journal on Scientific Computing 17, 16-32, 1996, choice 2); and, where CG
   * does, no further than along directions in which energy is stored: so the step descends.
   *
   * Where bonds break, fragments may become disconnected from the supports, which makes the tangent singular:
   * springs of 1e-8 of their stiffness hold each of their nodes where it was then. No load acts on them but
   * their own.
   *
   * The motions that a scene leaves free are removed from residuals and steps, as in statics: in their
   * direction, the balance is that of the undeformed body.
   *
   * KINSOL through deal.II 9.4 is not used: in a release build it does not report that SUNDIALS failed, it
   * stops by a maximum norm fixed at the beginning although reactions change, and its line search lowers |r|
   * only and computes every force twice.
   */
  template <int dim>
  class NewtonSolver : public EquilibriumPath<dim>
  {
  public:
    using typename EquilibriumPath<dim>::Controls;

    /// Tells which owned nodes are disconnected from the supports. Collective.
    using FindFloating = std::function<std::vector<bool>()>;

    /// @param tangent of the force, the operator behind @p system and @p linear. The arguments must
    /// outlive this object. Collective.
    /// @param find_floating empty where nothing breaks
    NewtonSolver(BondForce<dim>            &bonds,
                 TangentOperator<dim>      &tangent,
                 ConstrainedOperator<dim>  &system,
                 TangentSolver<dim>        &linear,
                 const DirichletNodes<dim> &held,
                 const Loads<dim>          &loads,
                 const NullSpace<dim>      &null_space,
                 const Controls            &controls,
                 FaceValues<dim>           *face_values   = nullptr,
                 const FindFloating        &find_floating = {});

    using EquilibriumPath<dim>::displacement;

    /// Nodes of all ranks that springs hold.
    GlobalIndex n_floating() const override { return anchors.n_nodes; }

    void register_state(LastingState &state) override;

  protected:
    typename EquilibriumPath<dim>::Norms measure(const NodalVector &external) override;
    void                                 forget_motion() override { anchor(); }

    /// Linearises the force about the present state; by the secant where a tangent that is not symmetric
    /// would suit no linear solver. Collective.
    void linearise(const Slope slope);
    /// Solves for the correction of the residual; tells the result of failures. Collective.
    bool solve(EquilibriumStep &result, const bool descends = false);
    /// External and internal force of free components, motions that are free taken out.
    void compute_residual(const NodalVector &external);
    /// Begins a step whose held components stand in their places.
    void start_in_place();
    /// The force on free components as held components, and faces as prepared, move by their increments.
    void force_of_supports(NodalVector &result);
    /// What a linear system may leave of its first residual.
    double relative_tolerance() const;

    using EquilibriumPath<dim>::force;
    using EquilibriumPath<dim>::held;

    TangentOperator<dim>     &tangent;
    ConstrainedOperator<dim> &system;
    TangentSolver<dim>       &linear;
    const NullSpace<dim>     &null_space;
    NodalVector               held_increment, residual, correction;
    /// Whether bonds that soften may jump to an equilibrium far off.
    bool may_jump = true;

  private:
    void start_step(const NodalVector &external, const double time) override;
    /// Goes on as in the last step; false, with the body where it was, where that leads to no state near an
    /// equilibrium. Collective.
    bool start_along_last_step(const NodalVector &external, const double time);
    bool is_in_place() const override { return in_place; }
    bool iterate(const NodalVector &external, EquilibriumStep &result) override;
    /// Holds the nodes that are disconnected from the supports. Collective.
    void anchor();

    /// Forces of one search.
    static constexpr unsigned int max_trials = 20;

    /// iterate() of bonds that soften, with supports in place.
    bool iterate_softening(const NodalVector &external, EquilibriumStep &result);
    /// Moves along the step as far as it helps; false, with the body where it was, where nothing did.
    /// Collective.
    /// @param n_uphill trials where the energy does not fall at the beginning of the step
    /// @param longest how often over the step is gone where the energy falls by more than half of its slope
    /// still
    bool search(const NodalVector &external, const unsigned int n_uphill, const double longest = 1.);

    /// The springs that hold disconnected nodes: where they are at rest [m], how stiff the nodes are in the
    /// whole body [N/m], and how many nodes they hold.
    struct Anchors
    {
      FindFloating find_floating;
      NodalVector  place, rest_stiffness;
      GlobalIndex  n_nodes = 0;
    };
    Anchors anchors;

    /// Whether held components are where they belong; else they have their increments still to move.
    bool                                 in_place = true;
    typename EquilibriumPath<dim>::Norms norms    = {};

    /// Where a line search begins; the squared residual before the last iteration [N^2], or zero; of bonds
    /// that soften, the least one of the step, and how long it has been.
    struct Search
    {
      NodalVector  start;
      unsigned int n_in_vain        = 0;
      double       earlier_residual = 0, least_residual = 0;
    };
    Search searching;
  };
} // namespace perideal

#endif
