// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_floating_nodes_h
#define perideal_fracture_floating_nodes_h

#include <perideal/neighbourhood/bond_list.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace perideal
{
  /**
   * Finds the owned nodes that are disconnected from the supports: no chain of bonds connects them with a
   * node that is held in all components or, where the body has no such node, with any that is held. No node
   * floats in a body that is not held at all. Collective.
   * @param is_lost whether the bond in a slot carries no force any more
   * @param held by dim*node + component of owned nodes, 1 where held
   */
  template <int dim>
  std::vector<bool> find_floating_nodes(const Families<dim>                        &families,
                                        const BondList                             &bonds,
                                        const std::function<bool(const BondIndex)> &is_lost,
                                        const std::vector<std::uint8_t>            &held);
} // namespace perideal

#endif
