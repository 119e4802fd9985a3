// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_nodes_curve_order_h
#define perideal_nodes_curve_order_h

#include <perideal/base/types.h>

#include <deal.II/base/point.h>

#include <vector>

namespace perideal
{
  /// Returns the numbers of the points in the order in which a Hilbert curve visits them. Consecutive points
  /// lie close together, which the search for neighbours relies on.
  template <int dim>
  std::vector<LocalIndex> order_along_curve(const std::vector<dealii::Point<dim>> &points);
} // namespace perideal

#endif
