// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_equilibrium_path_h
#define perideal_solvers_equilibrium_path_h

#include <perideal/boundary/dirichlet_nodes.h>
#include <perideal/boundary/face_values.h>
#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/system/constrained_operator.h>
#include <perideal/output/lasting_state.h>
#include <perideal/solvers/explicit_dynamics.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace perideal
{
  /// Describes the search for the equilibrium of one load step.
  struct EquilibriumStep
  {
    bool         converged  = false;
    unsigned int iterations = 0;
    /// Of linear solves, all together; of solvers that have such.
    unsigned int linear_iterations = 0;
    /// Bonds of all ranks that broke.
    GlobalIndex broken = 0;
    /// Relative residual norms, by iteration.
    std::vector<double> residuals;
    /// Why it went no further, where the solver knows; else empty.
    std::string problem;
    /// Whether it stopped at an equilibrium whose bonds are to be judged on another mesh.
    bool wants_mesh = false;

    /// Counts the work of earlier attempts and parts of the step to this one.
    void add_before(const EquilibriumStep &earlier)
    {
      iterations += earlier.iterations;
      linear_iterations += earlier.linear_iterations;
      broken += earlier.broken;
      residuals.insert(residuals.begin(), earlier.residuals.begin(), earlier.residuals.end());
    }
  };

  /**
   * Follows the equilibria of the nonlinear force of bonds along load steps, whatever method finds them:
   * decides when the body is at rest and when bonds break, and keeps the energy balance.
   *
   * Bonds are judged at equilibrium only, since the iterates between are no motion of the body: where the
   * residual has come below 1e-4, and again below the tolerance, all bonds beyond their limit break at
   * once; equilibrium is then sought again, until none breaks. Bonds that soften do so along with the search,
   * each iterate by itself leaving them what it would if the body came to it from the last equilibrium; at
   * rest that is for good. Where bonds have to take the place of cells first, equilibrium is sought again
   * before any is judged.
   */
  template <int dim>
  class EquilibriumPath
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
      /// Whether bonds that do not soften are to be judged on another mesh, asked on all ranks at each
      /// equilibrium before they are, and before they take the place of cells; where it returns true, the
      /// step ends. None: never.
      std::function<bool()> wants_mesh = {};
    };

    virtual ~EquilibriumPath() = default;

    /// Called with the iteration and the relative residual.
    using Progress = std::function<void(const unsigned int, const double)>;

    /**
     * Goes on from where the last step ended to the equilibrium at a time. A failure is reported, not
     * thrown. Collective.
     * @param external force of the loads at that time [N]
     */
    EquilibriumStep step(const NodalVector &external, const double time, const Progress &progress);

    /**
     * Energies at the last equilibrium, none kinetic or damped. External work is summed by the trapezoidal
     * rule over all equilibria, those before bonds broke included; dissipated is what came of work and
     * strain energy between a break and the next equilibrium. The rest is the error of the rule.
     */
    const EnergyBudget &energy() const { return last.energy; }
    /// Forces of the supports at the last equilibrium [N], zero in free components.
    const NodalVector &reaction() const { return last.support_force; }
    /// Those at prescribed values of faces [N], by entry.
    const std::vector<dealii::Tensor<1, dim>> &face_reaction() const { return last.face_support_force; }
    GlobalIndex                                n_broken() const { return breaks.total; }
    /// Number of nodes of all ranks that are disconnected from the supports, and held where they were.
    virtual GlobalIndex n_floating() const { return 0; }

    /// Restores the last equilibrium, for another attempt at the next; broken bonds stay broken.
    void restore();

    /// Registers what the next step needs of the last equilibrium.
    virtual void register_state(LastingState &state);
    /// Goes on from a state of an earlier run, with the bonds that broke until then broken. Collective.
    /// @param external force of the loads at that time [N]
    virtual void resume(const NodalVector &external, const double time);

    /// After resume() on another mesh than that of the state: goes on to the equilibrium at the same loads,
    /// with bonds as they are; what is stored less by then than on the mesh before counts as switched. A
    /// failure is reported, not thrown. Collective.
    EquilibriumStep come_to_rest(const NodalVector &external, const double time, const Progress &progress);

    /// At the last equilibrium, or where a failed search stopped [m].
    NodalVector displacement;

  protected:
    /// The arguments but the system, which gives the nodes, must outlive this object.
    /// @param face_values that the force carries, which this object moves; null: none
    EquilibriumPath(BondForce<dim>                 &bonds,
                    const ConstrainedOperator<dim> &system,
                    const DirichletNodes<dim>      &held,
                    const Loads<dim>               &loads,
                    const Controls                 &controls,
                    FaceValues<dim>                *face_values = nullptr);

    /// Squared norms of forces, of all ranks.
    struct Norms
    {
      double residual, reaction, load;
    };

    /// Begins a step; the forces are computed next. Collective.
    virtual void start_step(const NodalVector &external, const double time) = 0;
    /// Norms at the present state. Collective.
    virtual Norms measure(const NodalVector &external) = 0;
    /// False while held components are not yet where they belong.
    virtual bool is_in_place() const { return true; }
    /// One iteration, its forces included; false, with the problem, where there is none. Collective.
    virtual bool iterate(const NodalVector &external, EquilibriumStep &result) = 0;
    /// After bonds broke.
    virtual void forget_motion() {}

    void compute_forces();

    /// Lets bonds take the place of cells that come near to breaking; returns whether there is another force
    /// now, whose equilibrium is to be sought. Collective.
    bool extend_bonds();

    /// Lets bonds soften or break for good at the present displacement; returns how many broke. Collective.
    GlobalIndex judge(const NodalVector &external);

    /// Positions y are rounded by eps |y|: forgives what that makes of forces in a body whose nodes
    /// have these stiffnesses by component [N/m].
    void set_rounding(const NodalVector &stiffness);

    /// Keeps the present state as an equilibrium: its energies and forces. Collective.
    void balance(const NodalVector &external, const NodalVector &internal, const double strain_energy);

    /// What has gone since the last equilibrium of the work done on the body, by the trapezoidal rule, and is
    /// not in its bonds [J]. Collective.
    double dissipated_since(const NodalVector &external) const
    {
      const Work work = work_since(external, force);
      return work.external - work.switched - (bonds.strain_energy() - last.energy.strain);
    }

    BondForce<dim>            &bonds;
    const DirichletNodes<dim> &held;
    const Loads<dim>          &loads;
    const Controls             controls;
    FaceValues<dim>           *face_values;

    /// Of the bonds, now and before [N].
    NodalVector force, earlier_force;
    /// Motion in this step [m].
    NodalVector increment;

    /// The norm of the forces that rounding the positions makes [N], and where these were at rest.
    struct Rounding
    {
      std::vector<double> rest_position;
      double              force = 0;
    };
    Rounding rounding;

    /// Bonds broken since the beginning, and whether some broke in this step, and since the last equilibrium.
    struct Breaks
    {
      GlobalIndex total   = 0;
      bool        in_step = false, in_segment = false;
      /// Bonds softened for good in the last iteration.
      bool in_iteration = false;
      /// Bonds stay as they are, whatever they bear.
      bool wait = false;
      /// What softening may dissipate in a step, which fails if it is more [J].
      double most_dissipated = std::numeric_limits<double>::infinity();
    };
    Breaks breaks;

    /// The last equilibrium: forces are those of loads and supports [N], the largest load the square of the
    /// largest norm of loads or reactions at any equilibrium so far [N^2]; the motion in the step there [m],
    /// when it was and by how much it changed the time. Once bonds have taken the place of cells it is none
    /// any more: the imbalance is the force on free components there then [N].
    struct Equilibrium
    {
      NodalVector                         displacement, external, support_force, imbalance;
      std::vector<dealii::Tensor<1, dim>> face_support_force, face_value;
      EnergyBudget                        energy;
      double                              largest_load = 0;
      NodalVector                         motion;
      double                              time = 0, time_change = 0;

      /// Notes loads and reactions.
      void note(const Norms &norms) { largest_load = std::max({largest_load, norms.reaction, norms.load}); }
      /// Notes a step. Where bonds have taken the place of cells, equilibrium is sought twice at a time.
      void note_step(const NodalVector &increment, const double now)
      {
        if (now == time)
          motion += increment;
        else
          {
            motion      = increment;
            time_change = now - time;
            time        = now;
          }
      }
    };
    Equilibrium last;

  private:
    /// Keeps displacement, loads, supports and values at faces as those of the last equilibrium.
    void keep(const NodalVector &external, const NodalVector &internal);
    /// By the trapezoidal rule, since the last equilibrium [J]: the work of loads and supports, and what of
    /// that of its imbalance is lost as the body comes to rest.
    struct Work
    {
      double external = 0, switched = 0;
    };
    /// Collective.
    Work work_since(const NodalVector &external, const NodalVector &internal) const;
  };
} // namespace perideal

#endif
