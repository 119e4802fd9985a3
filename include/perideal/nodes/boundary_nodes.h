// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_nodes_boundary_nodes_h
#define perideal_nodes_boundary_nodes_h

#include <perideal/nodes/nodes.h>

#include <vector>

namespace perideal
{
  /// This rank's nodes whose cells have a face on the boundary, in ascending
  /// order; a cell that meets the boundary in a vertex or an edge only does not count.
  template <int dim>
  std::vector<LocalIndex> nodes_on_boundary(const Mesh<dim>                 &mesh,
                                            const Nodes<dim>                &nodes,
                                            const dealii::types::boundary_id boundary);
} // namespace perideal

#endif
