// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_contact_parameters_h
#define perideal_operators_force_contact_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace perideal
{
  /// Section "Contact".
  struct ContactParameters
  {
    /// automatic | true | false
    std::string enabled = "automatic";
    /// Contact distance over the mean spacing, and over the distance at rest [-].
    double distance = 0.9;
    /// Stiffness of a pair in terms of K V/horizon^2 [-].
    double stiffness = 3.;

    void declare(dealii::ParameterHandler &prm);
    /// @throws InputError on values outside their ranges.
    void check() const;
  };
} // namespace perideal

#endif
