// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_floating_nodes_h
#define perideal_drivers_floating_nodes_h

#include <perideal/problem/problem.h>

#include <vector>

namespace perideal
{
  /// Finds the owned nodes that the bonds which the force has left connect with no support. Collective.
  template <int dim>
  std::vector<bool> floating_nodes(const Problem<dim> &problem);
} // namespace perideal

#endif
