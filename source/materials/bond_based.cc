// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/bond_based.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  BondBased<dim>::BondBased(const double thickness, const std::vector<double> &stiffening)
    : thickness(thickness)
    , stiffening(stiffening)
  {
  }

  template <int dim>
  void BondBased<dim>::compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients)
  {
    // T = c e/|xi|, a half of it from either family; as stiffness eps xi with eps = |xi| e
    // the bond pulls with stiffness |xi|^2 e.
    const double modulus = micromodulus(family.bulk_modulus, family.horizon, thickness) *
                           (stiffening.empty() ? 1. : stiffening[family.node]);
    for (LocalIndex j = 0; j < family.size; ++j)
      coefficients.stiffness[j] = 0.5 * modulus * family.node_volume * family.volume[j] /
                                  (family.length_square[j] * std::sqrt(family.length_square[j]));
  }

  template <int dim>
  double BondBased<dim>::sphere_moment(const double horizon)
  {
    using dealii::numbers::PI;
    return dim == 3 ? PI * std::pow(horizon, 4) : 2. * PI / 3. * std::pow(horizon, 3);
  }

  template <int dim>
  double BondBased<dim>::micromodulus(const double bulk_modulus, const double horizon, const double thickness)
  {
    return 2. * dim * dim * bulk_modulus / (thickness * sphere_moment(horizon));
  }

  template <int dim>
  PairForce<dim> BondBased<dim>::pair_force(const ElasticSolid<dim>                    &solid,
                                            const double                                horizon,
                                            const typename LinearModel<dim>::Kinematics kinematics) const
  {
    const double c = micromodulus(solid.isotropic().bulk_modulus(), horizon, thickness);
    using Vector   = dealii::Tensor<1, dim>;
    if (kinematics == LinearModel<dim>::Kinematics::linear)
      return [c](const Vector &xi, const Vector &eta) {
        const double length = xi.norm();
        return c * (xi * eta) / (length * length * length) * xi;
      };
    return [c](const Vector &xi, const Vector &eta) {
      // |xi + eta| - |xi|, without the cancellation.
      const Vector y      = xi + eta;
      const double before = xi.norm(), after = y.norm();
      const double stretch = (2. * xi + eta) * eta / ((before + after) * before);
      return c * stretch / after * y;
    };
  }

  PERIDEAL_INSTANTIATE_CLASS(BondBased)
} // namespace perideal
