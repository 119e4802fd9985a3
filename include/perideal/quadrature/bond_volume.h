// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_bond_volume_h
#define perideal_quadrature_bond_volume_h

#include <perideal/neighbourhood/volume_rule.h>
#include <perideal/quadrature/quadrature_parameters.h>

#include <algorithm>
#include <memory>

namespace perideal
{
  /// Stores with the nodes what the scheme needs of their cells, before families are made. Collective.
  template <int dim>
  void prepare_cells(const QuadratureParameters &parameters, const Mesh<dim> &mesh, Nodes<dim> &nodes);

  /// The rule of a scheme; null for one point.
  template <int dim>
  std::shared_ptr<const VolumeRule<dim>> create_volume_rule(const QuadratureParameters &parameters);

  /// Returns the share of a square or cube on this side of a plane across it, from the distance of its middle
  /// to the plane in widths [-].
  inline double clamped_share(const double widths)
  {
    return std::min(1., std::max(0., widths + 0.5));
  }

  /**
   * The share of a square or cube of width D that lies within a distance d, when it is thought to lie across
   * a bond of length l [-]:
   *
   *     beta = min(1, max(0, (d + D/2 - l)/D)),
   *
   * the correction of EMU (Parks, Lehoucq, Plimpton, Silling 2008; K. Yu's thesis, eq. (2.16)).
   */
  inline double linear_share(const double distance, const double width, const double length)
  {
    return clamped_share((distance - length) / width);
  }

  /**
   * The share beta of the volume of node @p j that its bond counts in the family of @p i [-], by the
   * families' rule. It differs between the ends of a bond where cells or horizons do, and may be zero at one
   * of them.
   */
  template <int dim>
  double volume_share(const Families<dim> &families, const LocalIndex i, const LocalIndex j)
  {
    return families.volume_rule ? families.volume_rule->share(families, i, j) : 1.;
  }

  /// beta V_j [m^3].
  template <int dim>
  double counted_volume(const Families<dim> &families, const LocalIndex i, const LocalIndex j)
  {
    return volume_share(families, i, j) * families.volume[j];
  }

  /// sum beta V |xi| over the family of an owned node: int |xi| dV by the quadrature [m^4].
  template <int dim>
  double first_moment(const Families<dim> &families, const LocalIndex i);
} // namespace perideal

#endif
