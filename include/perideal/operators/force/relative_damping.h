// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_relative_damping_h
#define perideal_operators_force_relative_damping_h

#include <perideal/operators/force/bond_force.h>

#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Computes the viscous force between bonded nodes along the bond, by which a node's motion against its
   * family dies out at a rate c [1/s]:
   *
   *     F_i = sum_j g_ij ((v_j - v_i).n) n,   g_ij = dim c/2 (m_i V_j/V(H_i) + m_j V_i/V(H_j)),
   *
   * n the direction of the bond, V(H_i) the volume of the family at rest. Central and equal and opposite:
   * momentum and angular momentum stay, and rigid motions, rotations too, are not damped at all.
   *
   * After K. Yu's eq. (3.64), f = c (s + c_v (v_j - v_i)) n, where a scalar and a vector are added: what is
   * meant is the part of the velocity along n. There damping goes with the stiffness of a bond, here with
   * masses, so that its rate is the same on every mesh.
   */
  template <int dim>
  class RelativeDamping
  {
  public:
    /// Collective.
    /// @param rate c [1/s]
    /// @param density by material id [kg/m^3]
    RelativeDamping(const std::shared_ptr<const BondWeights<dim>>                 &weights,
                    const double                                                   rate,
                    const std::function<double(const dealii::types::material_id)> &density);

    /// Writes the forces on owned nodes [N] at the positions of the last @p bonds.compute(). Collective.
    /// @param velocity of owned nodes [m/s]
    void compute(NodalVector &force, const NodalVector &velocity, const BondForce<dim> &bonds);

    /**
     * Returns an upper bound of the largest eigenvalue of M^-1 C at rest [1/s], about 2 c. With velocities
     * half a step old, central differences are stable for
     *
     *     omega^2 dt^2 + 2 gamma dt < 4,
     *
     * from the roots of z^2 - (2 - omega^2 dt^2 - gamma dt) z + 1 - gamma dt.
     */
    double largest_rate() const { return bound; }

  private:
    double find_largest_rate(const BondList &bonds, const std::vector<double> &mass) const;

    std::shared_ptr<const Families<dim>> families;
    /// g_ij by slot [kg/s].
    std::vector<double> coefficient;
    std::size_t         n_lost_taken = 0;
    NodalVector         ghosted_velocity;
    double              bound = 0;
  };

  /// The largest stable time step [s] of a body whose undamped one is given, damped at a rate [1/s]; see
  /// RelativeDamping::largest_rate().
  double damped_time_step(const double undamped, const double rate);
} // namespace perideal

#endif
