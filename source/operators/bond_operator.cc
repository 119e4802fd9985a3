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
    const FamilyShape shape = model.shape();
    if (shape.n_sums == 1 && !shape.own_force_weights)
      return std::make_unique<FamilyOperator<dim, 1, false>>(families, model, moduli);
    if (shape.n_sums == 1)
      return std::make_unique<FamilyOperator<dim, 1, true>>(families, model, moduli);
    AssertThrow(shape.n_sums == 2 && !shape.own_force_weights, dealii::ExcNotImplemented());
    return std::make_unique<FamilyOperator<dim, 2, false>>(families, model, moduli);
  }

  template class BondOperator<2>;
  template class BondOperator<3>;
  template std::unique_ptr<BondOperator<2>>
  create_bond_operator(const std::shared_ptr<const Families<2>> &,
                       LinearModel<2> &,
                       const std::function<Moduli(const dealii::types::material_id)> &);
  template std::unique_ptr<BondOperator<3>>
  create_bond_operator(const std::shared_ptr<const Families<3>> &,
                       LinearModel<3> &,
                       const std::function<Moduli(const dealii::types::material_id)> &);
} // namespace perideal
