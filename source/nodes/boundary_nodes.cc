// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/boundary_nodes.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  std::vector<LocalIndex>
  nodes_on_boundary(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const dealii::types::boundary_id boundary)
  {
    std::vector<LocalIndex> result;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        {
          const auto faces   = cell->face_iterators();
          const bool touches = std::any_of(faces.begin(), faces.end(), [&](const auto &face) {
            return face->at_boundary() && face->boundary_id() == boundary;
          });
          if (touches)
            result.push_back(nodes.node_of_cell[cell->active_cell_index()]);
        }
    std::sort(result.begin(), result.end());
    return result;
  }

  PERIDEAL_INSTANTIATE(nodes_on_boundary)
} // namespace perideal
