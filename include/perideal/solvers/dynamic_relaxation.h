// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_dynamic_relaxation_h
#define perideal_solvers_dynamic_relaxation_h

#include <perideal/solvers/equilibrium_path.h>

namespace perideal
{
  /**
   * Equilibrium by adaptive dynamic relaxation (XOSB section 4.2): a damped motion with fictitious masses and
   * unit time step, by central differences, comes to rest where the forces balance.
   *
   * Masses, one a component: M = lambda D/4 with D the diagonal of the linear operator at rest and lambda
   * an upper estimate of the largest eigenvalue of D^-1 K, the smallest masses for which
   * a unit step is stable. XOSB's row sums of another model's stiffness (eq. 79) are no bound. Where
   * the motion itself shows a quotient v.Kv/v.Mv above 4, because bonds turned, stiffened or broke, the
   * masses grow.
   *
   * Damping c = 2 omega (Underwood), with omega^2 = d.Kd/d.Md, where K d is what the forces changed by
   * during the motion d since some 1/omega iterations ago; 0 where that is negative, at most 1.9. XOSB's
   * quotients by component and iteration (eqs. 77, 78), which divide by velocities, are sensitive to rounding
   * near the equilibrium. Masses differ by component, which takes fewer iterations than masses by node.
   *
   * The iterations grow with the length of a body in cells (figures: tests/performance/details.md).
   *
   *
   *
   * A step begins as the last one went on, unless bonds broke in it; after a break the body relaxes from
   * rest.
   */
  template <int dim>
  class DynamicRelaxation : public EquilibriumPath<dim>
  {
  public:
    using typename EquilibriumPath<dim>::Controls;

    /// @param system the linear operator of the same bonds; read by the constructor. Collective.
    /// The other arguments must outlive this object.
    DynamicRelaxation(BondForce<dim>                 &bonds,
                      const ConstrainedOperator<dim> &system,
                      const DirichletNodes<dim>      &held,
                      const Loads<dim>               &loads,
                      const Controls                 &controls);

    using EquilibriumPath<dim>::displacement;

    void register_state(LastingState &state) override;

  private:
    /// Of all ranks: norms of forces, and products of the motion.
    struct Sums
    {
      typename EquilibriumPath<dim>::Norms forces;
      /// Of the last iteration: change of force squared, v.Kv, v.Mv.
      double change, v_K_v, v_M_v;
      /// Since the anchor: d.Kd, d.Md.
      double d_K_d, d_M_d;
    };

    void                                 start_step(const NodalVector &external, const double time) override;
    typename EquilibriumPath<dim>::Norms measure(const NodalVector &external) override;
    bool iterate(const NodalVector &external, EquilibriumStep &result) override;
    void forget_motion() override;

    void set_masses(const ConstrainedOperator<dim> &system);
    /// Norms and products at the present state. Collective.
    Sums sum_up(const NodalVector &external) const;
    void adapt();
    void move(const NodalVector &external);

    using EquilibriumPath<dim>::force;
    using EquilibriumPath<dim>::earlier_force;
    using EquilibriumPath<dim>::held;

    NodalVector mass, velocity;
    /// Where the motion was that the damping is taken from.
    NodalVector  anchor, anchor_force;
    unsigned int since_anchor = 0;
    bool         in_motion = false, anchor_is_start = true;
    double       damping = 0;
    /// At the present state.
    Sums sums = {};
  };
} // namespace perideal

#endif
