// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_create_drivers_h
#define perideal_drivers_create_drivers_h

#include <perideal/drivers/driver.h>

namespace perideal
{
  /// Makes the driver of linear statics.
  template <int dim>
  std::unique_ptr<Driver<dim>> create_static_driver(Problem<dim> &problem);

  /// Makes the driver of equilibria along load steps: Newton's method or dynamic relaxation.
  template <int dim>
  std::unique_ptr<Driver<dim>> create_equilibrium_driver(Problem<dim> &problem);

  /// Makes the driver of explicit dynamics.
  template <int dim>
  std::unique_ptr<Driver<dim>> create_dynamics_driver(Problem<dim> &problem);
} // namespace perideal

#endif
