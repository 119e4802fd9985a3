// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/family_operator.h>
#include <perideal/operators/linear/tensor_operator.h>

namespace perideal
{
  template <int dim>
  std::unique_ptr<BondOperator<dim>>
  create_bond_operator(const std::shared_ptr<const Families<dim>> &families,
                       LinearModel<dim>                           &model,
                       const SolidOf<dim>                         &solid_of)
  {
    return create_bond_operator<dim>(weigh_bonds(families, model, solid_of));
  }

  template <int dim>
  std::unique_ptr<BondOperator<dim>>
  create_bond_operator(const std::shared_ptr<const BondWeights<dim>> &weights)
  {
    if (weights->shape.bond_tensors)
      return std::make_unique<TensorOperator<dim>>(
        std::static_pointer_cast<const TensorWeights<dim>>(weights));
    return visit_family_shape(weights->shape,
                              [&](const auto n_sums, const auto own) -> std::unique_ptr<BondOperator<dim>> {
                                return std::make_unique<FamilyOperator<dim, n_sums, own>>(
                                  std::static_pointer_cast<const FamilyWeights<dim, n_sums, own>>(weights));
                              });
  }

  PERIDEAL_INSTANTIATE_CLASS(BondOperator)
  template std::unique_ptr<BondOperator<2>>
  create_bond_operator(const std::shared_ptr<const BondWeights<2>> &);
  template std::unique_ptr<BondOperator<3>>
  create_bond_operator(const std::shared_ptr<const BondWeights<3>> &);
  template std::unique_ptr<BondOperator<2>>
  create_bond_operator(const std::shared_ptr<const Families<2>> &, LinearModel<2> &, const SolidOf<2> &);
  template std::unique_ptr<BondOperator<3>>
  create_bond_operator(const std::shared_ptr<const Families<3>> &, LinearModel<3> &, const SolidOf<3> &);
} // namespace perideal
