// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_dynamic_relaxation_h
#define perideal_solvers_dynamic_relaxation_h

#include <perideal/boundary/held_nodes.h>
#include <perideal/operators/bond_force.h>
#include <perideal/operators/constrained_operator.h>
#include <perideal/solvers/explicit_dynamics.h>

#include <functional>
#include <vector>

namespace perideal
{
  /// What the relaxation of one load step did.
  struct RelaxedStep
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    /// Bonds of all ranks that broke.
    GlobalIndex broken = 0;
    /// Relative residual norms, by iteration.
    std::vector<double> residuals;
  };

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
   * quotients by component and iteration (eqs. 77, 78), which divide by velocities, take as many iterations
   * until rounding spoils them: 1,152 nodes under a strain of 1e-7 came to a residual of 1e-7 in 620
   * iterations, by eq. 77 not in 6,000. Masses by node, the largest of its diagonal, took 1 to 4 per cent
   * more iterations than masses by component, and ten Lanczos steps once underestimated their lambda.
   *
   * The iterations grow with the length of a body in cells: 212, 444 and 892 for plates with 1,920, 7,680
   * and 30,720 nodes to 1e-6, 2.4 to 2.5 times those of conjugate gradients with block Jacobi.
   *
   * Bonds are judged at equilibrium only, since the motion there is none of the body: where the
   * residual has come below 1e-4, and again below the tolerance, all bonds beyond their limit break at
   * once; the body then relaxes from rest, until none breaks.
   */
  template <int dim>
  class DynamicRelaxation
  {
  public:
    struct Controls
    {
      /**
       * Residual norm of the free components over that of the loads or of the reactions at which
       * the body is at rest; the largest of these norms now and at any earlier equilibrium counts, so
       * that a body that broke can come to rest. What rounding the positions makes of forces always will do.
       */
      double tolerance = 1e-8;
      /// Iterations after which an equilibrium has failed; counted anew after every break.
      unsigned int max_iterations = 5000;
      /// Whether bonds are judged.
      bool bonds_break = false;
    };

    /// Called with the iteration and the relative residual.
    using Progress = std::function<void(const unsigned int, const double)>;

    /// @param system the linear operator of the same bonds; read by the constructor. Collective.
    /// The other arguments must outlive this object.
    DynamicRelaxation(BondForce<dim>                 &bonds,
                      const ConstrainedOperator<dim> &system,
                      const HeldNodes<dim>           &held,
                      const Loads<dim>               &loads,
                      const Controls                 &controls);

    /**
     * Goes on to the equilibrium at a time, from where the last step ended, moved on as that step moved
     * unless bonds broke in it. A failure is reported, not thrown. Collective.
     * @param external force of the loads at that time [N]
     */
    RelaxedStep relax(const NodalVector &external, const double time, const Progress &progress);

    /**
     * Energies at the last equilibrium, none kinetic or damped. External work is summed by the trapezoidal
     * rule over all equilibria, those before bonds broke included; dissipated is what came of work and
     * strain energy between a break and the next equilibrium. The rest is the error of the rule.
     */
    const EnergyBudget &energy() const { return budget; }
    /// Forces of the supports at the last equilibrium [N], zero in free components.
    const NodalVector &reaction() const { return support_force; }
    GlobalIndex        n_broken() const { return broken; }

    /// At the last equilibrium, or where a failed relaxation stopped [m].
    NodalVector displacement;

  private:
    /// Of all ranks: squared norms of forces, and products of the motion.
    struct Sums
    {
      double residual, reaction, load;
      /// Of the last iteration: change of force squared, v.Kv, v.Mv.
      double change, v_K_v, v_M_v;
      /// Since the anchor: d.Kd, d.Md.
      double d_K_d, d_M_d;
    };

    void set_masses(const ConstrainedOperator<dim> &system);
    void start_step(const double time);
    void stop_motion();
    void compute_forces();
    /// Norms and products at the present state. Collective.
    Sums measure(const NodalVector &external) const;
    void adapt(const Sums &sums);
    void move(const NodalVector &external);
    /// Judges the bonds; returns how many broke. Collective.
    GlobalIndex break_bonds(const NodalVector &external);
    /// Work and energies between the last equilibrium and this one.
    void balance(const NodalVector &external, const NodalVector &internal, const double strain_energy);

    BondForce<dim>       &bonds;
    const HeldNodes<dim> &held;
    const Loads<dim>     &loads;
    const Controls        controls;
    std::vector<double>   rest_position;

    NodalVector mass, velocity, force, earlier_force;
    /// Where the motion was that the damping is taken from.
    NodalVector  anchor, anchor_force;
    unsigned int since_anchor = 0;
    bool         in_motion = false, anchor_is_start = true;
    double       damping = 0;
    /// Norm of the forces that rounding the positions makes [N].
    double rounding = 0;

    /// At the last equilibrium.
    NodalVector last_displacement, last_external, support_force;
    NodalVector increment;
    double      last_time = 0, last_interval = 0, largest_load = 0;
    bool        broke_in_step = false, broke_in_segment = false;

    EnergyBudget budget;
    GlobalIndex  broken = 0;
  };
} // namespace perideal

#endif
