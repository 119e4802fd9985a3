// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/bond_based.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  BondBased<dim>::BondBased(const double thickness)
    : thickness(thickness)
  {
  }

  template <int dim>
  void BondBased<dim>::compute(const FamilyView<dim> &family, FamilyCoefficients &coefficients)
  {
    // T = c e/|xi|, a half of it from either family; as stiffness eps xi with eps = |xi| e
    // the bond pulls with stiffness |xi|^2 e.
    const double modulus = micromodulus(family.bulk_modulus, family.horizon, thickness);
    for (LocalIndex j = 0; j < family.size; ++j)
      coefficients.stiffness[j] = 0.5 * modulus * family.node_volume * family.volume[j] /
                                  (family.length_square[j] * std::sqrt(family.length_square[j]));
  }

  template <int dim>
  double BondBased<dim>::micromodulus(const double bulk_modulus, const double horizon, const double thickness)
  {
    using dealii::numbers::PI;
    const double first_moment =
      dim == 3 ? PI * std::pow(horizon, 4) : thickness * 2. * PI / 3. * std::pow(horizon, 3);
    return 2. * dim * dim * bulk_modulus / first_moment;
  }

  template class BondBased<2>;
  template class BondBased<3>;
} // namespace perideal
