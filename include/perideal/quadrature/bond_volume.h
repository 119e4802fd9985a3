// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_bond_volume_h
#define perideal_quadrature_bond_volume_h

#include <perideal/neighbourhood/families.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace perideal
{
  /// Section "Quadrature".
  struct QuadratureParameters
  {
    /// one point | partial volume | gauss points: how much of a neighbour's volume a bond counts, and where.
    std::string scheme = "one point";
    /// Gauss points of a cell in each direction, and radius of the supports of moving least squares, in
    /// spacings of the cell [-].
    unsigned int gauss_points   = 2;
    double       support_radius = 3.;

    void declare(dealii::ParameterHandler &prm);
    /// @throws InputError on supports that hold no points.
    void check() const;

    /// Whether cells have several points, whose displacements are interpolated.
    bool has_gauss_points() const { return scheme == "gauss points"; }

    bool counts_parts() const { return scheme == "partial volume"; }

    /// How far families reach beyond horizons, in spacings of the neighbour [-]: NodeCloud::margin.
    double margin() const { return has_gauss_points() ? 0.87 : counts_parts() ? 0.5 : 0.; }
  };

  /**
   * The share beta of the volume of node @p j that its bond counts in the family of @p i [-]. One where
   * families reach as far as horizons; else the part within the horizon d_i of a cell of width D_j that is
   * thought to lie across the bond xi,
   *
   *     beta = min(1, max(0, (d_i + D_j/2 - |xi|)/D_j)),
   *
   * the correction of EMU (Parks, Lehoucq, Plimpton, Silling 2008) without its cut at |xi| = d_i. It differs
   * between the ends of a bond where spacings do, and may be zero at one of them.
   */
  template <int dim>
  double volume_share(const Families<dim> &families, const LocalIndex i, const LocalIndex j);

  /// beta V_j [m^3].
  template <int dim>
  double counted_volume(const Families<dim> &families, const LocalIndex i, const LocalIndex j)
  {
    return volume_share(families, i, j) * families.volume[j];
  }
} // namespace perideal

#endif
