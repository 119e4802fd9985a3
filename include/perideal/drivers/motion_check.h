// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_motion_check_h
#define perideal_drivers_motion_check_h

#include <perideal/problem/problem.h>
#include <perideal/solvers/explicit_dynamics.h>

namespace perideal
{
  /// Tells a motion from what an unstable time step makes of one.
  template <int dim>
  class MotionCheck
  {
  public:
    /// The problem must outlive this object.
    explicit MotionCheck(const Problem<dim> &problem);

    /// Looks at a step of which a row or a frame is to be made. Collective.
    /// @param largest_energy of the run so far [J] @param stable_step the largest stable one [s]
    /// @throws ComputationError on all ranks when the motion is not finite, or its energy comes from nowhere.
    void look(const ExplicitDynamics<dim> &dynamics,
              const EnergyBudget          &energy,
              const double                 largest_energy,
              const double                 stable_step);

  private:
    /// Number and place of the fastest node of all ranks. Collective.
    std::string fastest_node(const ExplicitDynamics<dim> &dynamics) const;

    const Problem<dim> &problem;
    /// Times in succession at which more than half of the energy was missing.
    unsigned int rows_without_balance = 0;
  };
} // namespace perideal

#endif
