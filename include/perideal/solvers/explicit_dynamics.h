// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_explicit_dynamics_h
#define perideal_solvers_explicit_dynamics_h

#include <perideal/boundary/dirichlet_nodes.h>
#include <perideal/boundary/face_values.h>
#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/force/contact_force.h>
#include <perideal/operators/force/relative_damping.h>
#include <perideal/solvers/sub_steps.h>

#include <deal.II/base/tensor.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace perideal
{
  class LastingState;

  /// Energies of all ranks [J].
  struct EnergyBudget
  {
    double kinetic = 0, strain = 0;
    /// Of nodes pressed on each other.
    double contact = 0;
    /// Set free by breaking bonds; taken by damping; put in by loads and supports.
    double dissipated = 0, damped = 0, external = 0;
    /// By which bonds store less than the cells whose place they take in a FractureZone.
    double switched = 0;

    /// Returns the energy balance error [J]: the energy put in less the energy there is and the energy lost;
    /// zero but for the error of the integration.
    double imbalance() const
    {
      return external - (kinetic + strain + contact + dissipated + damped + switched);
    }
  };

  /**
   * Integrates motion by central differences: velocities at half steps, v(+) = v(-) + dt F/m, u = u + dt v(+)
   * (symplectic Euler, XOSB eq. 74). Started half a step back it is velocity Verlet.
   *
   * The energy that this conserves is m v(-).v(+)/2 + U; the work of loads, supports and damping is
   * summed by the trapezoidal rule, dt/2 v.(F(n) + F(n+1)), which belongs to it.
   */
  template <int dim>
  class ExplicitDynamics
  {
  public:
    enum class Start
    {
      symplectic_euler,
      velocity_verlet
    };

    /// @param mass of owned nodes [kg]
    /// @param damping force over mass and velocity [1/s]
    /// The arguments must outlive this object.
    ExplicitDynamics(BondForce<dim>            &bonds,
                     const DirichletNodes<dim> &held,
                     const Loads<dim>          &loads,
                     const std::vector<double> &mass,
                     const double               damping,
                     const double               time_step,
                     const Start                start);

    /// Adds contact, or damping of relative velocities; what is added must outlive this object.
    void set_contact(ContactForce<dim> *force) { added.contact = force; }
    void set_relative_damping(RelativeDamping<dim> *relative);

    /// Lets small cells take shorter steps between two of these; without contact, and where nothing breaks.
    void take_sub_steps(const std::shared_ptr<const LocalSteps> &steps);

    /// Moves prescribed values at faces, which the force reads, besides the held nodes: to where they are at
    /// the present time. They must outlive this object.
    /// @param start where they are at t = 0 [m], by entry
    void move_faces(FaceValues<dim> &values, const std::vector<dealii::Tensor<1, dim>> &start);

    /// Moves held nodes of a changed mesh to where they are at the present time: what was carried to them is
    /// where those of other cells are held.
    /// @param start where they are at t = 0 [m], by component of the owned nodes
    void move_held_nodes(const NodalVector &start);

    /// Forces, velocities of the next half step and energies at the present time;
    /// to be followed by advance(). Collective.
    /// @param external force of the loads [N]
    void evaluate(const NodalVector &external);

    /// Adds work of what is none of the forces here to the energy put in [J].
    /// @param of_all of all ranks
    void add_work(const double of_all);

    /// Counts what has gone since the energies had an imbalance as switched: the mesh is another one.
    /// @return that, of all ranks [J]
    double switch_mesh(const double imbalance)
    {
      const double gone = energy().imbalance() - imbalance;
      breaks.switched += gone;
      return gone;
    }

    /// Goes on with steps that were so many times as long: velocities come from half of such a step before.
    void divide_steps(const unsigned int parts)
    {
      n_steps *= parts;
      scheme.later = 0.5 * (1. - parts) * scheme.time_step;
    }

    /// Advances by one step.
    void advance();

    /// Registers what the next step needs of this one, after advance().
    void register_state(LastingState &state);

    double        time() const { return n_steps * scheme.time_step; }
    std::uint64_t step() const { return n_steps; }

    /// Energies at the present time, after evaluate(), to which it brings back the force where there are
    /// sub-steps. Collective.
    EnergyBudget energy() const;
    /// Momentum of the body half a step later, after evaluate() [kg m/s]. Collective.
    dealii::Tensor<1, dim> momentum() const;
    /// Angular momentum about the origin half a step later, after evaluate() [kg m^2/s]; in 2-D about z. The
    /// scheme keeps it where forces have no moment. Collective.
    dealii::Tensor<1, 3> angular_momentum() const;
    /// Forces of the supports on nodes at the present time [N], zero in free components.
    const NodalVector &reaction() const { return work.support_force; }
    /// Forces of the supports at the prescribed faces at the present time [N], by entry.
    std::vector<dealii::Tensor<1, dim>> face_reaction() const
    {
      return added.sub_steps ? added.sub_steps->support_forces() : bonds.support_forces();
    }
    GlobalIndex n_broken() const { return breaks.total; }
    GlobalIndex n_broken_now() const { return breaks.now; }

    /// Displacement [m] at the present time, velocity [m/s] half a step before it or, after evaluate(),
    /// half a step after it.
    NodalVector displacement, velocity;

  private:
    /// Puts the effective force of sub-steps in the place of that of the bonds.
    void take_steps_between(const NodalVector &external);

    /// Adds the work of supports at faces in the halves of a step before and after the present time, and
    /// finds how far they go next.
    void work_of_faces();

    BondForce<dim>   &bonds;
    const Loads<dim> &loads;

    /// Nodes that are held, and prescribed values at faces, null without; how far these went in the last step
    /// [m].
    struct Held
    {
      const DirichletNodes<dim>          &nodes;
      FaceValues<dim>                    *faces = nullptr;
      std::vector<dealii::Tensor<1, dim>> moved = {};
    };
    Held held;

    const std::vector<double> &mass;

    struct Scheme
    {
      double damping, time_step;
      Start  start;
      /// Velocities are given so much later than they are wanted [s]; once they are taken there, 0.
      double later = 0.;
    };
    Scheme scheme;

    /// What changes the force of the bonds: others that add theirs, and shorter steps of small cells; null
    /// without.
    struct Added
    {
      ContactForce<dim>             *contact   = nullptr;
      RelativeDamping<dim>          *damping   = nullptr;
      std::unique_ptr<SubSteps<dim>> sub_steps = nullptr;
    };
    Added added;

    /// The drag is that of relative damping; empty without.
    struct Work
    {
      NodalVector force, earlier_velocity, support_force, relative_drag;
    };
    Work          work;
    std::uint64_t n_steps = 0;

    /// Of all ranks: bonds broken, now and so far, the energy that they set free, and that switched.
    struct Breaks
    {
      GlobalIndex total = 0, now = 0;
      double      energy = 0, switched = 0;
    };
    Breaks breaks;

    /// Energies of this rank at the present time, and those powers times half a step that belong to the next
    /// interval.
    struct Shares
    {
      double kinetic = 0, damped = 0, external_work = 0;
      /// What sub-steps take from the kinetic energy.
      double between     = 0;
      double next_damped = 0, next_external_work = 0;
    };
    Shares own;
  };
} // namespace perideal

#endif
