// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/intact_gradients.h>
#include <perideal/reconstruction/family_quadratics.h>

namespace perideal
{
  template <int dim>
  NodalVector displacement_of(const Families<dim> &families, const BondForce<dim> &force)
  {
    NodalVector result(families.make_partitioner(dim));
    for (LocalIndex i = 0; i < families.n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        result.local_element(dim * i + d) = force.positions()[i].value[d] - families.position[i][d];
    return result;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> intact_gradients(const Families<dim>           &families,
                                                       const BondForce<dim>          &force,
                                                       const NodalVector             &displacement,
                                                       const std::vector<LocalIndex> &nodes)
  {
    const BondList       &bonds = force.bond_list();
    FamilyQuadratics<dim> fit(families, displacement, nodes);
    std::vector<bool>     is_lost(bonds.n_slots(), false);
    for (const auto &bond : force.lost_bonds())
      is_lost[bond.slot] = true;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot];
            j != i && !is_lost[slot] && force.softening_bonds().share(slot) == 1.)
          {
            fit.add(i, j);
            fit.add(j, i);
          }
    return fit.gradients();
  }

  PERIDEAL_INSTANTIATE(displacement_of)
  PERIDEAL_INSTANTIATE(intact_gradients)
} // namespace perideal
