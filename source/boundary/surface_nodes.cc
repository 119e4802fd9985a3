// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/surface_nodes.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  SurfaceNodes<dim>::SurfaceNodes(const NodeCloud<dim>                 &real,
                                  const std::vector<BoundaryFace<dim>> &faces,
                                  const Loads<dim>                     &loads)
    : all(real)
  {
    Assert(!real.has_cells && real.shape.empty(), dealii::ExcNotImplemented());
    const auto is_held = [&](const dealii::types::boundary_id id) {
      return std::any_of(loads.conditions.begin(), loads.conditions.end(), [&](const auto &condition) {
        return condition.prescribes_displacement() && condition.acts_on(id);
      });
    };
    for (const BoundaryFace<dim> &face : faces)
      if (is_held(face.boundary))
        {
          nodes_of_cells.push_back(face.node);
          held_faces.push_back(face);
          held_faces.back().node = all.size();
          all.position.push_back(face.centre);
          all.volume.push_back(real.volume[face.node]);
          all.spacing.push_back(real.spacing[face.node]);
          if (!all.finest.empty())
            all.finest.push_back(real.finest[face.node]);
          if (!all.cell_radius.empty())
            all.cell_radius.push_back(real.cell_radius[face.node]);
          all.horizon.push_back(real.horizon[face.node]);
          all.material.push_back(real.material[face.node]);
        }
    all.number();
  }

  PERIDEAL_INSTANTIATE_CLASS(SurfaceNodes)
} // namespace perideal
