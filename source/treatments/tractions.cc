// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/treatments/tractions.h>

namespace perideal
{
  template <int dim>
  Resultant<dim> Tractions<dim>::resultant(const unsigned int condition,
                                           const double       time,
                                           const NodalVector &displacement) const
  {
    Loads<dim> alone = body.loads;
    for (unsigned int other = 0; other < alone.conditions.size(); ++other)
      if (other != condition)
        {
          alone.conditions[other].traction = {};
          alone.conditions[other].pressure = {};
        }
    NodalVector force;
    force.reinit(displacement);
    add_tractions(alone, time, force);
    return add_up(force);
  }

  template <int dim>
  Resultant<dim> Tractions<dim>::add_up(const NodalVector &force) const
  {
    Resultant<dim> result;
    for (LocalIndex i = 0; i < body.nodes.size(); ++i)
      {
        dealii::Tensor<1, dim> acting;
        for (int d = 0; d < dim; ++d)
          acting[d] = force.local_element(dim * i + d);
        result.add(body.nodes.position[i], acting);
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Tractions)
} // namespace perideal
