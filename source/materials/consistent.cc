// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/consistent.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  Consistent<dim>::Consistent(const InfluenceFunction &influence,
                              const double             stabilisation,
                              const double             thickness)
    : influence(influence)
    , stabilisation(stabilisation)
    , thickness(thickness)
  {
  }

  template <int dim>
  double Consistent<dim>::bond_share(const double length_square,
                                     const double bond_horizon,
                                     const double volume,
                                     const double other_volume) const
  {
    // omega by the bond's horizon from both ends, so that the share is one number a bond.
    return influence.value(std::sqrt(length_square), bond_horizon, bond_horizon) * volume * other_volume /
           length_square;
  }

  template <int dim>
  double Consistent<dim>::family_share(const double shear_modulus, const double horizon) const
  {
    // wd = (dim+2)/2 wh, wh = dim/m omega, m the analytic weighted volume (XOSB 24, 25, 28).
    const double weighted_volume = influence.template weighted_volume<dim>(horizon) * thickness;
    return stabilisation * shear_modulus * dim * (dim + 2) / weighted_volume;
  }

  template class Consistent<2>;
  template class Consistent<3>;
} // namespace perideal
