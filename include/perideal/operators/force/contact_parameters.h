// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_contact_parameters_h
#define perideal_operators_force_contact_parameters_h

#include <perideal/parameters/choice.h>

#include <deal.II/base/parameter_handler.h>

namespace perideal
{
  /// Whether nodes repel each other.
  enum class ContactChoice
  {
    automatic,
    yes,
    no
  };

  template <>
  struct ChoiceNames<ContactChoice>
  {
    static constexpr const char *list[] = {"automatic", "true", "false"};
  };

  /// Section "Contact".
  struct ContactParameters
  {
    ContactChoice enabled = ContactChoice::automatic;
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
