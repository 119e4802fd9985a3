// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_nodes_cell_keys_h
#define perideal_nodes_cell_keys_h

#include <perideal/nodes/nodes.h>

namespace perideal
{
  /// Returns for each owned node a number that identifies its cell in the mesh, for any number of ranks:
  /// that of the coarse cell, and the way down to its descendant.
  template <int dim>
  std::vector<std::uint64_t> cell_keys(const Mesh<dim> &mesh, const Nodes<dim> &nodes);
} // namespace perideal

#endif
