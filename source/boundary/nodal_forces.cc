// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/nodal_forces.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  void compute_nodal_forces(const Nodes<dim>                                           &nodes,
                            const std::vector<BoundaryFace<dim>>                       &faces,
                            const Loads<dim>                                           &loads,
                            const std::vector<std::vector<dealii::types::boundary_id>> &boundaries,
                            const double                                                time,
                            NodalVector                                                &force)
  {
    force = 0.;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        const auto body_force = loads.body_force_at(nodes.position[i], time);
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * i + d) = body_force[d] * nodes.volume[i];
      }
    for (std::size_t k = 0; k < loads.conditions.size(); ++k)
      if (loads.conditions[k].prescribes_traction())
        for (const BoundaryFace<dim> &face : faces)
          if (std::count(boundaries[k].begin(), boundaries[k].end(), face.boundary) > 0)
            {
              const auto traction = Loads<dim>::traction(loads.conditions[k], face.centre, face.normal, time);
              for (int d = 0; d < dim; ++d)
                force.local_element(dim * face.node + d) += traction[d] * face.area;
            }
  }

  template void compute_nodal_forces(const Nodes<2> &,
                                     const std::vector<BoundaryFace<2>> &,
                                     const Loads<2> &,
                                     const std::vector<std::vector<dealii::types::boundary_id>> &,
                                     const double,
                                     NodalVector &);
  template void compute_nodal_forces(const Nodes<3> &,
                                     const std::vector<BoundaryFace<3>> &,
                                     const Loads<3> &,
                                     const std::vector<std::vector<dealii::types::boundary_id>> &,
                                     const double,
                                     NodalVector &);
} // namespace perideal
