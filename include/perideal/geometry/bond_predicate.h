// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_geometry_bond_predicate_h
#define perideal_geometry_bond_predicate_h

#include <deal.II/base/point.h>

#include <functional>

namespace perideal
{
  /// Whether something is true of the bond between two positions, in either order.
  template <int dim>
  using BondPredicate = std::function<bool(const dealii::Point<dim> &, const dealii::Point<dim> &)>;
} // namespace perideal

#endif
