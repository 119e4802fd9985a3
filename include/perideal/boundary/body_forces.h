// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_body_forces_h
#define perideal_boundary_body_forces_h

#include <perideal/base/types.h>
#include <perideal/nodes/nodes.h>
#include <perideal/parameters/load_parameters.h>

namespace perideal
{
  /// Writes the body force times the volume of each node of a cell [N]; nodes behind those keep what they
  /// have.
  template <int dim>
  void
  set_body_forces(const Nodes<dim> &nodes, const Loads<dim> &loads, const double time, NodalVector &force);
} // namespace perideal

#endif
