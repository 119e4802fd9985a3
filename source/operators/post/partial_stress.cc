// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/post/partial_stress.h>

namespace perideal
{
  template <int dim, typename Bonds>
  std::vector<dealii::Tensor<2, dim>> partial_stress(const Families<dim> &families, const Bonds &bonds)
  {
    std::vector<dealii::Tensor<2, dim>> result(families.n_owned());
    bonds.visit_bond_forces([&](const LocalIndex i, const LocalIndex j, const dealii::Tensor<1, dim> &force) {
      // The same from either end.
      const auto virial = 0.5 * outer_product(force, families.position[j] - families.position[i]);
      result[i] += virial;
      if (j < families.n_owned())
        result[j] += virial;
    });
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      result[i] /= families.volume[i];
    return result;
  }

  template std::vector<dealii::Tensor<2, 2>> partial_stress(const Families<2> &, const BondOperator<2> &);
  template std::vector<dealii::Tensor<2, 3>> partial_stress(const Families<3> &, const BondOperator<3> &);
  template std::vector<dealii::Tensor<2, 2>> partial_stress(const Families<2> &, const BondForce<2> &);
  template std::vector<dealii::Tensor<2, 3>> partial_stress(const Families<3> &, const BondForce<3> &);
} // namespace perideal
