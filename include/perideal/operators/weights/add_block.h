// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_add_block_h
#define perideal_operators_weights_add_block_h

#include <perideal/base/types.h>

#include <functional>
#include <vector>

namespace perideal
{
  /// Receives the entries [N/m] that some unknowns (global numbers, dim*number + component) have in each
  /// other's rows of a stiffness matrix: values[r * unknowns.size() + c].
  using AddBlock =
    std::function<void(const std::vector<GlobalIndex> &unknowns, const std::vector<double> &values)>;
} // namespace perideal

#endif
