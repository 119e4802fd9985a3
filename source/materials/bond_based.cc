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
    using dealii::numbers::PI;
    const double d            = family.horizon;
    const double first_moment = dim == 3 ? PI * std::pow(d, 4) : thickness * 2. * PI / 3. * std::pow(d, 3);
    const double micromodulus = 2. * dim * dim * family.bulk_modulus / first_moment;
    for (LocalIndex j = 0; j < family.size; ++j)
      coefficients.stiffness[j] = 0.5 * micromodulus * family.node_volume * family.volume[j] /
                                  (family.length_square[j] * std::sqrt(family.length_square[j]));
  }

  template class BondBased<2>;
  template class BondBased<3>;
} // namespace perideal
