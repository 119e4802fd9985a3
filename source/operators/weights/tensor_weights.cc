// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/weights/tensor_weights.h>

namespace perideal
{
  template <int dim>
  TensorWeights<dim>::TensorWeights(const std::shared_ptr<const Families<dim>> &families,
                                    LinearModel<dim>                           &model,
                                    const SolidOf<dim>                         &solid_of,
                                    const BondPredicate<dim>                   &is_cut)
    : BondWeights<dim>(families, model)
  {
    for (auto &values : this->component)
      values.assign(this->bonds.n_slots(), 0.);
    FamilyCoefficients coefficients;
    this->visit_families(
      solid_of, is_cut, [&](const FamilyView<dim> &family, const std::vector<BondCursor::End> &ends) {
        this->weigh(model, family, coefficients);
        for (LocalIndex k = 0; k < family.size; ++k)
          for (unsigned int p = 0; p < this->n_components; ++p)
            this->component[p][ends[family.member[k]].slot] += coefficients.tensor[p][k];
      });
    add_far_ends();
    this->count_reports();
  }

  template <int dim>
  void TensorWeights<dim>::add_far_ends()
  {
    const Families<dim>             &families = *this->families;
    std::vector<std::vector<double>> far_values(this->n_components);
    std::vector<const double *>      near;
    std::vector<double *>            far;
    for (unsigned int p = 0; p < this->n_components; ++p)
      {
        far_values[p].assign(this->bonds.n_slots(), 0.);
        near.push_back(this->component[p].data());
        far.push_back(far_values[p].data());
      }
    exchange_cut_bonds(families, this->bonds, near, far);
    for (LocalIndex i = 0; i < this->bonds.n_rows(); ++i)
      for (BondIndex slot = this->bonds.row[i]; slot < this->bonds.row[i + 1]; ++slot)
        if (this->bonds.neighbour[slot] >= families.n_owned())
          for (unsigned int p = 0; p < this->n_components; ++p)
            this->component[p][slot] += far_values[p][slot];
  }

  PERIDEAL_INSTANTIATE_CLASS(TensorWeights)
} // namespace perideal
