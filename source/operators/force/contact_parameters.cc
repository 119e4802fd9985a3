// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>
#include <perideal/operators/force/contact_parameters.h>

namespace perideal
{
  void ContactParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Contact");
    prm.add_parameter(
      "Enabled",
      enabled,
      "Whether nodes without an intact bond repel each other when they come too close, in dynamics; "
      "automatic: where bonds can break or there are precracks");
    prm.add_parameter("Distance",
                      distance,
                      "Below which nodes repel, over their mean spacing and over their distance at rest, "
                      "0 < distance <= 1 [-]",
                      Double());
    prm.add_parameter(
      "Stiffness",
      stiffness,
      "Force over overlap of two nodes, in bulk moduli times volume over squared horizon, > 0; a "
      "whole family holds its node with 12 [-]",
      Double());
    prm.leave_subsection();
  }

  void ContactParameters::check() const
  {
    InputErrorCollector errors;
    if (!(distance > 0 && distance <= 1))
      errors.add(
        InputError("the value is out of range").parameter("Contact/Distance").allowed("0 < distance <= 1"));
    // Four contacts of 12 are an eigenvalue of 96 where the intact body has some 15.
    if (!(stiffness > 0 && stiffness <= 12))
      errors.add(InputError("the value is out of range")
                   .parameter("Contact/Stiffness")
                   .allowed("0 < stiffness <= 12; more needs smaller time steps than the body does"));
    errors.raise();
  }
} // namespace perideal
