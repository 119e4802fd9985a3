// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/linear_model.h>
#include <perideal/quadrature/bond_volume.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  void FamilyView<dim>::reinit(const Families<dim>                         &families,
                               const LocalIndex                             i,
                               const std::function<bool(const LocalIndex)> &is_gone)
  {
    const LocalIndex n = families.size(i);
    for (auto *values : {&volume, &length_square, &bond_horizon})
      values->resize(n);
    for (auto &component : bond)
      component.resize(n);
    member.resize(n);
    size        = 0;
    node        = i;
    node_volume = families.volume[i];
    horizon     = families.horizon[i];
    for (LocalIndex k = 0; k < n; ++k)
      {
        const LocalIndex j = families.begin(i)[k];
        if (is_gone && is_gone(j))
          continue;
        const double counted = counted_volume(families, i, j);
        if (!(counted > 0))
          continue;
        const auto xi = families.position[j] - families.position[i];
        for (int d = 0; d < dim; ++d)
          bond[d][size] = xi[d];
        length_square[size] = xi.norm_square();
        bond_horizon[size]  = std::max(horizon, families.horizon[j]);
        volume[size]        = counted;
        member[size]        = k;
        ++size;
      }
    for (auto *values : {&volume, &length_square, &bond_horizon})
      values->resize(size);
    for (auto &component : bond)
      component.resize(size);
    member.resize(size);
  }

  template <int dim>
  void FamilyView<dim>::set_solid(const ElasticSolid<dim> &solid)
  {
    bulk_modulus  = solid.isotropic().bulk_modulus();
    shear_modulus = solid.isotropic().shear_modulus();
    stiffness     = solid.stiffness();
  }

  void FamilyCoefficients::resize(const LocalIndex n, const FamilyShape &shape)
  {
    for (unsigned int a = 0; a < shape.n_sums; ++a)
      {
        sum[a].resize(n);
        if (shape.own_force_weights)
          force_weight[a].resize(n);
      }
    for (auto &component : tensor)
      component.resize(shape.bond_tensors ? n : 0);
    stiffness.resize(shape.bond_tensors ? 0 : n);
    energy = 0;
    report = {};
  }

  PERIDEAL_INSTANTIATE_CLASS(FamilyView)
} // namespace perideal
