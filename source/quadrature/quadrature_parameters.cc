// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>
#include <perideal/quadrature/quadrature_parameters.h>

namespace perideal
{
  void QuadratureParameters::declare(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.enter_subsection("Quadrature");
    prm.add_parameter(
      "Scheme",
      scheme,
      "How much of a neighbour's volume a bond counts: one point: all of it where the neighbour lies within "
      "the horizon; cubic cell: of these neighbours the part of their cells that does, taken as linear in "
      "the distance; partial volume: that part also of cells with their centre outside; exact: the part of "
      "each "
      "cell that the horizon cuts, for cells of any shape; adaptive: the same by integration with error "
      "control; gauss points: several points in each cell, with displacements interpolated by moving least "
      "squares "
      "(bond based, statics; all but one point: not with the consistent form)");
    prm.add_parameter("Adaptive rule",
                      adaptive_rule,
                      "Points of adaptive integration: gauss: Gauss points between the kinks of its limits; "
                      "trapezoid: intervals that are halved, as in K. Yu's thesis, up to a million points a "
                      "cell, which takes a thousand times longer");
    prm.add_parameter("Relative tolerance",
                      relative_tolerance,
                      "Adaptive integration ends when a share changes by less than this, over the share "
                      "itself; above 0 [-]",
                      Double());
    prm.add_parameter("Absolute tolerance",
                      absolute_tolerance,
                      "Share of a cell from which on down the relative tolerance is one of the whole cell; "
                      "above 0 [-]",
                      Double());
    prm.add_parameter(
      "Gauss points", gauss_points, "Gauss points of a cell in each direction [-]", Integer(1, 4));
    prm.add_parameter(
      "Support radius",
      support_radius,
      "Gauss points: radius within which nodes make the displacement of a point, in spacings of its "
      "cell, 1.5 to 6 [-]",
      Double());
    prm.leave_subsection();
  }

  void QuadratureParameters::check() const
  {
    InputErrorCollector errors;
    const auto          check_tolerance = [&](const double value, const std::string &name) {
      if (!(value > 0))
        errors.add(InputError("integration never gets there")
                     .parameter("Quadrature/" + name)
                     .allowed("above 0; 1e-6 is usual"));
    };
    check_tolerance(relative_tolerance, "Relative tolerance");
    check_tolerance(absolute_tolerance, "Absolute tolerance");
    if (!(support_radius >= 1.5 && support_radius <= 6.))
      errors.add(InputError("no quadratic fit has such supports")
                   .parameter("Quadrature/Support radius")
                   .given(std::to_string(support_radius))
                   .allowed("1.5 to 6; 3 is usual"));
    errors.raise();
  }
} // namespace perideal
