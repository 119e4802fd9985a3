// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_heating_h
#define perideal_drivers_heating_h

#include <perideal/problem/problem.h>

#include <memory>

namespace perideal
{
  /**
   * Finds the energy that changes of temperature put into the body: U with the expansions after a step less U
   * with those before, at the displacement before the step and at that after it, of which the work is the
   * mean. Nothing where the scene gives no temperature.
   *
   * In each step: remember(), the loads are set, take_loads(), the body moves and its forces are computed,
   * work(), or go_back().
   */
  template <int dim>
  class Heating
  {
  public:
    explicit Heating(const Problem<dim> &problem)
      : problem(problem)
    {
    }

    /// Takes out all expansion: the body at rest, before the first load step.
    void begin_cold();

    /// Keeps the expansions of now. Collective.
    void remember();

    /// Compares energies at the displacement of the last forces. Collective.
    void take_loads();

    /// Compares them at that of the present forces. Returns the work since remember() [J]. Collective.
    double work();

    /// Takes back the expansions of remember(), for a step that failed. Collective.
    /// @param displacement before it
    void go_back(const NodalVector &displacement);

  private:
    const Problem<dim>                 &problem;
    std::unique_ptr<CellExpansion<dim>> earlier;
    double                              energy_before = 0, first_change = 0;
  };
} // namespace perideal

#endif
