// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/floating_nodes.h>
#include <perideal/fracture/floating_nodes.h>

namespace perideal
{
  template <int dim>
  std::vector<bool> floating_nodes(const Problem<dim> &problem)
  {
    const BondList   &bonds = problem.force->body_bonds();
    std::vector<bool> is_lost(bonds.n_slots(), false);
    for (const auto &bond : problem.force->lost_bonds())
      if (const BondIndex slot = bonds.find(bond.near, bond.far); slot != BondList::no_slot)
        is_lost[slot] = true;
    return find_floating_nodes(
      *problem.discretisation.families,
      bonds,
      [&](const BondIndex slot) { return is_lost[slot]; },
      problem.loading.supports->held().mask());
  }

  template std::vector<bool> floating_nodes(const Problem<2> &);
  template std::vector<bool> floating_nodes(const Problem<3> &);
} // namespace perideal
