// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_heating_h
#define perideal_drivers_heating_h

#include <perideal/problem/problem.h>

#include <array>
#include <memory>

namespace perideal
{
  /**
   * Finds the energy that a change of temperature puts into the body: U with the expansions after it less U
   * with those before, at the displacement before the step and at that after it, of which the work is the
   * mean. Nothing where the scene gives no temperature.
   */
  template <int dim>
  class Heating
  {
  public:
    /// To be made before the loads are set to the time of the step. Collective.
    explicit Heating(const Problem<dim> &problem);

    /// Returns the change of U at the displacement of the last forces [J], once the loads are set.
    /// Collective.
    double change();

    /// Returns the work [J], after the step. Collective.
    double work();

  private:
    const Problem<dim>                       &problem;
    std::unique_ptr<const CellExpansion<dim>> earlier;
    double                                    energy_before = 0, first_change = 0;
  };
} // namespace perideal

#endif
