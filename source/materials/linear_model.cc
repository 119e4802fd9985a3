// SPDX-License-Identifier: LGPL-2.1-or-later
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
    member.clear();
    volume.clear();
    for (LocalIndex k = 0; k < families.size(i); ++k)
      if (const LocalIndex j = families.begin(i)[k]; !is_gone || !is_gone(j))
        if (const double counted = counted_volume(families, i, j); counted > 0)
          {
            member.push_back(k);
            volume.push_back(counted);
          }
    size        = static_cast<LocalIndex>(member.size());
    node        = i;
    node_volume = families.volume[i];
    horizon     = families.horizon[i];
    for (auto &component : bond)
      component.resize(size);
    length_square.resize(size);
    bond_horizon.resize(size);
    for (LocalIndex k = 0; k < size; ++k)
      {
        const LocalIndex j  = families.begin(i)[member[k]];
        const auto       xi = families.position[j] - families.position[i];
        for (int d = 0; d < dim; ++d)
          bond[d][k] = xi[d];
        length_square[k] = xi.norm_square();
        bond_horizon[k]  = std::max(families.horizon[i], families.horizon[j]);
      }
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

  template struct FamilyView<2>;
  template struct FamilyView<3>;
} // namespace perideal
