// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_stable_time_step_h
#define perideal_operators_system_stable_time_step_h

#include <perideal/operators/system/constrained_operator.h>

#include <functional>

namespace perideal
{
  /**
   * Estimates the largest stable time step of explicit central differences, 2/omega_max [s], with
   * omega_max^2 the largest eigenvalue of M^-1 K from Lanczos steps, times 1.1
   * because they underestimate it; infinite where nothing is free to move. Collective.
   * @param density by material id [kg/m^3]
   */
  template <int dim>
  double stable_time_step(const ConstrainedOperator<dim>                                &system,
                          const std::function<double(const dealii::types::material_id)> &density);
} // namespace perideal

#endif
