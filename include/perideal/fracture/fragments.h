// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_fragments_h
#define perideal_fracture_fragments_h

#include <perideal/neighbourhood/bond_list.h>

#include <vector>

namespace perideal
{
  /**
   * Returns the volumes of the fragments of a body, largest first [m^3]: sets of nodes
   * with less than @p damaged damage that are connected from cell to cell, as far as cells that share a
   * corner. Fragments of less than half a per cent of the body are left out. Collective.
   * @param spacing, damage of owned nodes
   */
  template <int dim>
  std::vector<double> find_fragments(const Families<dim>       &families,
                                     const BondList            &bonds,
                                     const std::vector<double> &spacing,
                                     const std::vector<double> &damage,
                                     const double               damaged);
} // namespace perideal

#endif
