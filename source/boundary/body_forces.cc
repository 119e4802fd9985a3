// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/body_forces.h>

namespace perideal
{
  template <int dim>
  void
  set_body_forces(const Nodes<dim> &nodes, const Loads<dim> &loads, const double time, NodalVector &force)
  {
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        const auto body_force = loads.body_force_at(nodes.position[i], time);
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * i + d) = body_force[d] * nodes.volume[i];
      }
  }

  PERIDEAL_INSTANTIATE(set_body_forces)
} // namespace perideal
