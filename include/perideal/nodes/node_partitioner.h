// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_nodes_node_partitioner_h
#define perideal_nodes_node_partitioner_h

#include <perideal/base/types.h>

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// Layout of a field with @p n_components values a node, interleaved: nodes
  /// [first, first + n_owned) of n_global are this rank's; @p ghosts are global
  /// numbers of others it reads. Collective.
  inline std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
  make_node_partitioner(const GlobalIndex               first,
                        const LocalIndex                n_owned,
                        const GlobalIndex               n_global,
                        const std::vector<GlobalIndex> &ghosts,
                        const unsigned int              n_components,
                        MPI_Comm                        communicator)
  {
    dealii::IndexSet owned(n_global * n_components), read(n_global * n_components);
    owned.add_range(first * n_components, (first + n_owned) * n_components);
    for (const GlobalIndex number : ghosts)
      read.add_range(number * n_components, (number + 1) * n_components);
    read.compress();
    return std::make_shared<const dealii::Utilities::MPI::Partitioner>(owned, read, communicator);
  }
} // namespace perideal

#endif
