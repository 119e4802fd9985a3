// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/cell_keys.h>

namespace perideal
{
  template <int dim>
  std::vector<std::uint64_t> cell_keys(const Mesh<dim> &mesh, const Nodes<dim> &nodes)
  {
    std::vector<std::uint64_t> result(nodes.size());
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const dealii::CellId id = cell->id();
          AssertThrow(id.get_child_indices().size() < 32 / dim, dealii::ExcNotImplemented());
          // A leading one tells the first child of a cell from the cell.
          std::uint64_t way = 1;
          for (const std::uint8_t child : id.get_child_indices())
            way = (way << dim) | child;
          result[nodes.node_of_cell[cell->active_cell_index()]] =
            (static_cast<std::uint64_t>(id.get_coarse_cell_id()) << 32) | way;
        }
    return result;
  }

  PERIDEAL_INSTANTIATE(cell_keys)
} // namespace perideal
