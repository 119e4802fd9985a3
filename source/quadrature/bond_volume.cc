// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/quadrature/bond_volume.h>

#include <algorithm>

namespace perideal
{
  void QuadratureParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Quadrature");
    prm.add_parameter("Scheme",
                      scheme,
                      "How much of a neighbour's volume a bond counts: one point: all of it where the "
                      "neighbour lies within the horizon; partial volume: the part of its cell that does, "
                      "taken as linear in the distance, also of cells with their centre outside (not with "
                      "the consistent form); gauss points: several points in each cell, with displacements "
                      "interpolated by moving least squares (bond based, statics)",
                      dealii::Patterns::Selection("one point|partial volume|gauss points"));
    prm.add_parameter("Gauss points",
                      gauss_points,
                      "Gauss points of a cell in each direction [-]",
                      dealii::Patterns::Integer(1, 4));
    prm.add_parameter(
      "Support radius",
      support_radius,
      "Gauss points: radius within which nodes make the displacement of a point, in spacings of its "
      "cell, 1.5 to 6 [-]",
      dealii::Patterns::Double());
    prm.leave_subsection();
  }

  void QuadratureParameters::check() const
  {
    if (!(support_radius >= 1.5 && support_radius <= 6.))
      throw InputError("no quadratic fit has such supports")
        .parameter("Quadrature/Support radius")
        .given(std::to_string(support_radius))
        .allowed("1.5 to 6; 3 is usual");
  }

  template <int dim>
  double volume_share(const Families<dim> &families, const LocalIndex i, const LocalIndex j)
  {
    if (families.spacing.empty())
      return 1.;
    const double width  = families.spacing[j];
    const double length = families.position[i].distance(families.position[j]);
    const double share  = (families.horizon[i] + 0.5 * width - length) / width;
    // Round-off makes no members.
    return share < Families<dim>::negligible_share ? 0. : std::min(1., share);
  }

  template double volume_share(const Families<2> &, const LocalIndex, const LocalIndex);
  template double volume_share(const Families<3> &, const LocalIndex, const LocalIndex);
} // namespace perideal
