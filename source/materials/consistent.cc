// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/consistent.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  Consistent<dim>::Consistent(const InfluenceFunction &influence,
                              const double             stabilisation,
                              const double             horizon_factor)
    : influence(influence)
    // wd = (dim+2)/2 dim/m omega, m = m_1 horizon^(dim+2) the analytic weighted volume
    // (XOSB 24, 25, 28), horizon^dim = factor^dim V, horizon = |xi|/distance.
    , factor(stabilisation * dim * (dim + 2) /
             (influence.template weighted_volume<dim>(1.) * std::pow(horizon_factor, dim)))
  {
  }

  template <int dim>
  double Consistent<dim>::stabilising_modulus(const ElasticSolid<dim> &solid)
  {
    const double shear = solid.isotropic().shear_modulus();
    if (solid.is_isotropic())
      return shear;
    const double softest = 0.5 * smallest_stiffness(solid);
    return softest > 0 ? softest : shear;
  }

  PERIDEAL_INSTANTIATE_CLASS(Consistent)
} // namespace perideal
