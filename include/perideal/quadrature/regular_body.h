// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_regular_body_h
#define perideal_quadrature_regular_body_h

#include <perideal/quadrature/bond_volume.h>

namespace perideal
{
  /// int |xi| dV by the quadrature of a scheme over a whole family in a regular body of unit cells, of unit
  /// thickness in 2-D [-]. Families of cells of width D have D^(dim+1) times that.
  template <int dim>
  double regular_first_moment(const NodeParameters &nodes, const QuadratureParameters &quadrature);
} // namespace perideal

#endif
