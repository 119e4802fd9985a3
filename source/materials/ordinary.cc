// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/ordinary.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  void spherical_weights(const FamilyView<dim>   &family,
                         const InfluenceFunction &influence,
                         const double             thickness,
                         std::vector<double>     &hydrostatic)
  {
    hydrostatic.resize(family.size);
    const double factor = dim / (influence.template weighted_volume<dim>(family.horizon) * thickness);
    for (LocalIndex j = 0; j < family.size; ++j)
      hydrostatic[j] =
        factor * influence.value(std::sqrt(family.length_square[j]), family.horizon, family.bond_horizon[j]);
  }

  template <int dim>
  Ordinary<dim>::Ordinary(const InfluenceFunction &influence, const double thickness)
    : influence(influence)
    , thickness(thickness)
  {
  }

  template <int dim>
  void Ordinary<dim>::compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients)
  {
    // theta = sum_j wh |xi| e V_j                                  (XOSB eq. 26)
    // t     = kappa wh |xi| theta + 2 mu wd (e - theta |xi|/dim)   (XOSB eq. 17)
    // with wd = (dim+2)/2 wh, so that the two theta terms share one weight.
    const double mu = family.shear_modulus, kappa = family.bulk_modulus;
    spherical_weights(family, influence, thickness, weights);
    for (LocalIndex j = 0; j < family.size; ++j)
      {
        coefficients.sum[0][j] = weights[j] * family.volume[j];
        coefficients.stiffness[j] =
          mu * (dim + 2) * family.node_volume * weights[j] * family.volume[j] / family.length_square[j];
      }
    coefficients.map = {{family.node_volume * (kappa - mu * (dim + 2) / dim), 0., 0.}};
  }

  PERIDEAL_INSTANTIATE(spherical_weights)
  PERIDEAL_INSTANTIATE_CLASS(Ordinary)
} // namespace perideal
