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
   * Which owned nodes came loose: no chain of bonds leads to them from a node that is held in all
   * components; where the body has no such node, from any that is held. Nothing floats in a body that is not
   * held at all. Collective.
   * @param is_lost of bonds by slot
   * @param held by dim*node + component of owned nodes, 1 where held
   */
  template <int dim>
  std::vector<bool> find_floating_nodes(const Families<dim>                        &families,
                                        const BondList                             &bonds,
                                        const std::function<bool(const BondIndex)> &is_lost,
                                        const std::vector<std::uint8_t>            &held);
} // namespace perideal

#endif
