// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_nodal_records_h
#define perideal_operators_weights_nodal_records_h

#include <perideal/base/lanes.h>
#include <perideal/base/types.h>

#include <deal.II/base/aligned_vector.h>

#include <algorithm>

namespace perideal
{
  /// Copies a field with dim values a node into the records of the local nodes, those of ghosts from their
  /// owners. Collective.
  /// @param ghosted work space, with ghosts in the order of the records behind the owned nodes
  template <int dim>
  void import_nodal_records(const NodalVector                 &field,
                            NodalVector                       &ghosted,
                            dealii::AlignedVector<NodeRecord> &records)
  {
    const NodalVector *source = &field;
    if (dim * records.size() > field.locally_owned_size())
      {
        std::copy(field.begin(), field.begin() + field.locally_owned_size(), ghosted.begin());
        ghosted.update_ghost_values();
        source = &ghosted;
      }
    for (std::size_t i = 0; i < records.size(); ++i)
      for (int d = 0; d < dim; ++d)
        records[i].value[d] = source->local_element(dim * i + d);
    ghosted.zero_out_ghost_values();
  }
} // namespace perideal

#endif
