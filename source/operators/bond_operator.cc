// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/family_operator.h>

namespace perideal
{
  template <int dim>
  std::unique_ptr<BondOperator<dim>>
  create_bond_operator(const std::shared_ptr<const Families<dim>>                    &families,
                       LinearModel<dim>                                              &model,
                       const std::function<Moduli(const dealii::types::material_id)> &moduli)
  {
    return create_bond_operator<dim>(weigh_bonds(families, model, moduli));
  }

  template <int dim>
  std::unique_ptr<BondOperator<dim>>
  create_bond_operator(const std::shared_ptr<const BondWeights<dim>> &weights)
  {
    return visit_family_shape(weights->shape,
                              [&](const auto n_sums, const auto own) -> std::unique_ptr<BondOperator<dim>> {
                                return std::make_unique<FamilyOperator<dim, n_sums, own>>(
                                  std::static_pointer_cast<const FamilyWeights<dim, n_sums, own>>(weights));
                              });
  }

  template class BondOperator<2>;
  template class BondOperator<3>;
  template std::unique_ptr<BondOperator<2>>
  create_bond_operator(const std::shared_ptr<const BondWeights<2>> &);
  template std::unique_ptr<BondOperator<3>>
  create_bond_operator(const std::shared_ptr<const BondWeights<3>> &);
  template std::unique_ptr<BondOperator<2>>
  create_bond_operator(const std::shared_ptr<const Families<2>> &,
                       LinearModel<2> &,
                       const std::function<Moduli(const dealii::types::material_id)> &);
  template std::unique_ptr<BondOperator<3>>
  create_bond_operator(const std::shared_ptr<const Families<3>> &,
                       LinearModel<3> &,
                       const std::function<Moduli(const dealii::types::material_id)> &);
} // namespace perideal
