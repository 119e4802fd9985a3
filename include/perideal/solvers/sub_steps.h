// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_solvers_sub_steps_h
#define perideal_solvers_sub_steps_h

#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/force/levelled_force.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Lets small cells take shorter steps between two of the longest, Dt (leapfrog with local steps: Diaz,
   * Grote, SIAM Journal on Scientific Computing 31, 1985-2014, 2009; with many levels: Computer Methods in
   * Applied Mechanics and Engineering 291, 240-265, 2015). Leapfrog takes u(t + Dt) + u(t - Dt) - 2 u(t) from
   * the force; that is twice the way z(Dt) - u(t) of a body that starts from rest at t. On this way forces of
   * small cells are evaluated after every step of theirs, with the larger cells where they were at t; so what
   * leapfrog sees is an effective force,
   *
   *     F_eff = 2 m (z(Dt) - u)/Dt^2.
   *
   * Of two steps of dt = Dt/2, with f all forces at u and P the nodes that move,
   *
   *     w = dt^2 f/(2 m),  f_1 = f + F(u + P w) - F(u),  w_1 = dt^2 f_1/(2 m),  z(Dt) - u = 2 (w + w_1),
   *
   * and where cells are smaller still, w and w_1 come of two steps of dt/2 in the same way. Fast motions of
   * small cells are then at the bounds of what leapfrog bears for a long step, and what couples them to
   * larger cells may push them over. So the polynomial 2 (1 - T_2(1 - x/2)) of x = dt^2 k/m is damped as
   * those of Chebyshev methods are (Carle, Hochbruck, Sturm, SIAM Journal on Numerical Analysis 58,
   * 2404-2433, 2020; Grote, Michel, Sauter, Mathematics of Computation 90, 2603-2643, 2021):
   *
   *     2 (1 - T_2(nu - omega x)/T_2(nu)):  z(Dt) - u = (Dt/dt)^2 ((1 - 2 c) w + 2 c w_1),  c = omega/(2 nu),
   *
   * with Dt just below 2 dt (LocalSteps::growth_square).
   *
   * F_eff is zero where f is, sums up to zero as f does, and in linear elasticity has a potential:
   *
   *     m v(-).v(+)/2 + U - sum over the levels of sum_P 2 c m |w|^2/dt^2,  with w of the first step,
   *
   * is conserved as leapfrog conserves m v(-).v(+)/2 + U. Loads are
   * constant over Dt.
   *
   * Bonds that fail, and nodes that touch, are not for it: both would be looked at once in Dt, and what they
   * do to the energy of the way is not known.
   */
  template <int dim>
  class SubSteps
  {
  public:
    /// @param mass of owned nodes [kg] @param is_held by component of the owned nodes
    /// @param longest step [s]
    /// The arguments must outlive this object.
    SubSteps(BondForce<dim>                          &bonds,
             const std::shared_ptr<const LocalSteps> &steps,
             const std::vector<double>               &mass,
             const std::vector<std::uint8_t>         &is_held,
             const double                             longest);

    /// Computes the force of the bonds on the owned nodes. Collective.
    void compute(NodalVector &force, const NodalVector &displacement);

    /// Turns all that acts on the nodes after compute() into the effective force. Collective.
    /// @return what the motion between takes from the energy, of this rank [J]
    double take_steps(NodalVector &force);

    /// Forces that supports exert on the body at prescribed values at faces [N], by entry, that belong to the
    /// effective force of the last take_steps().
    std::vector<dealii::Tensor<1, dim>> support_forces() const;

    /// Brings the bonds back to the state of compute(), for who asks for their energy. Collective.
    void settle(const NodalVector &displacement);

  private:
    /// By component of the owned nodes, and behind them of the prescribed values at faces, which are nodes of
    /// unit mass that nothing moves.
    using Components = std::vector<double>;

    /// Finds the way from rest at the present place during a step of a level, of the nodes that the forces of
    /// this level change; of the highest one, of all.
    /// @param at_start whether that is where compute() was: the energy of the way counts
    void move(const unsigned int level, const Components &force, const bool at_start, Components &way);

    /// The way as long as the force is the same.
    double way_of(const Components &force, const std::size_t k, const double step) const
    {
      return 0.5 * step * step * force[k] / points[k / dim].mass;
    }

    /// The forces at the present place, those of the levels up to one.
    void   compute_parts(const unsigned int highest);
    double sum_of_parts(const std::size_t k, const unsigned int highest) const;

    /// Calls visit(k) with the components of some nodes; without those held.
    template <typename Visit>
    static void visit_components(const std::vector<LocalIndex> &nodes, const Visit &visit);
    template <typename Visit>
    void visit_free(const std::vector<LocalIndex> &nodes, const Visit &visit) const;

    double step_of(const unsigned int level) const;

    BondForce<dim>                   &bonds;
    LevelledForce                    &by_level;
    std::shared_ptr<const LocalSteps> steps;
    /// A node or a prescribed value, and the lowest level of the forces on it.
    struct Point
    {
      double       mass;
      unsigned int level;
    };
    std::vector<Point>               points;
    const std::size_t                n_nodal;
    const std::vector<std::uint8_t> &is_held;
    const double                     longest;

    /// Of the force, by level.
    std::vector<LevelledForce::Part> parts;

    /// Work space of a level: the way of its first shorter step, the force there, the parts of the force
    /// before, and where nodes were.
    struct Level
    {
      Components way, force, before, place;
      /// On which forces of levels up to this one act.
      std::vector<LocalIndex> pulled;
    };
    std::vector<Level> levels;
    NodalVector        place;
    Components         whole_way;
    double             energy = 0;
  };
} // namespace perideal

#endif
