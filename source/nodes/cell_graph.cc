// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/cell_graph.h>
#include <perideal/nodes/node_partitioner.h>

#include <deal.II/grid/grid_tools.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <numeric>

namespace perideal
{
  template <int dim>
  CellGraph<dim>::CellGraph(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const GhostLayers layers)
    : position(nodes.position)
    , material(nodes.material)
    , communicator(nodes.communicator)
    , n_owned_nodes(nodes.size())
    , first_global(nodes.first_global)
    , n_global(nodes.n_global)
    , node_of_cell(nodes.node_of_cell)
  {
    exchange_ghosts(mesh);
    collect_cells_at_vertices(mesh);
    if (layers == GhostLayers::two || mesh.material_ids.size() > 1)
      exchange_second_layer(mesh, layers);
    sort_ghosts();
    if (layers == GhostLayers::two)
      {
        around.owned.resize(n_owned_nodes);
        for (const Cell &cell : mesh.triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            around.owned[node_of(cell)] = cells_around(cell);
      }
    local_number_of_ghost.clear();
  }

  template <int dim>
  LocalIndex CellGraph<dim>::add_ghost(const Ghost &ghost)
  {
    if (ghost.first >= first_global && ghost.first < first_global + n_owned_nodes)
      return static_cast<LocalIndex>(ghost.first - first_global);
    const auto inserted = local_number_of_ghost.insert({ghost.first, n_local()});
    if (inserted.second)
      {
        ghost_number.push_back(ghost.first);
        position.push_back(ghost.second.first);
        material.push_back(ghost.second.second);
      }
    return inserted.first->second;
  }

  template <int dim>
  void CellGraph<dim>::exchange_ghosts(const Mesh<dim> &mesh)
  {
    dealii::GridTools::exchange_cell_data_to_ghosts<Ghost, dealii::Triangulation<dim>>(
      mesh.triangulation,
      [&](const Cell &cell) -> dealii::std_cxx17::optional<Ghost> {
        const LocalIndex i = node_of(cell);
        return Ghost(first_global + i, {position[i], material[i]});
      },
      [&](const Cell &cell, const Ghost &ghost) {
        node_of_cell[cell->active_cell_index()] = add_ghost(ghost);
      });
  }

  namespace
  {
    /// Calls visit(vertex) for the vertices of a cell and for those that hang on
    /// its edges and faces (p4est: one on the middle of each that is refined).
    template <int dim, typename Cell, typename Visit>
    void visit_vertices(const Cell &cell, const Visit &visit)
    {
      for (const unsigned int v : cell->vertex_indices())
        visit(cell->vertex_index(v));
      for (const unsigned int l : cell->line_indices())
        if (cell->line(l)->has_children())
          visit(cell->line(l)->child(0)->vertex_index(1));
      if constexpr (dim == 3)
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->has_children())
            visit(cell->face(f)->child(0)->vertex_index(3));
    }
  } // namespace

  template <int dim>
  void CellGraph<dim>::collect_cells_at_vertices(const Mesh<dim> &mesh)
  {
    const auto &triangulation = mesh.triangulation;
    first.assign(triangulation.n_vertices() + 1, 0);
    const auto for_each_pair = [&](const auto &act) {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (!cell->is_artificial())
          visit_vertices<dim>(cell, [&](const unsigned int vertex) { act(vertex, node_of(cell)); });
    };
    for_each_pair([&](const unsigned int vertex, const LocalIndex) { ++first[vertex + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    cells.resize(first.back());
    std::vector<unsigned int> next(first.begin(), first.end() - 1);
    for_each_pair([&](const unsigned int vertex, const LocalIndex node) { cells[next[vertex]++] = node; });
  }

  template <int dim>
  std::vector<LocalIndex> CellGraph<dim>::cells_around(const Cell &cell) const
  {
    if (!cell->is_locally_owned())
      return around.ghost.at(node_of(cell));
    std::vector<LocalIndex> result = {node_of(cell)};
    visit_vertices<dim>(cell, [&](const unsigned int vertex) { add_cells_at(vertex, result); });
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  template <int dim>
  void CellGraph<dim>::exchange_second_layer(const Mesh<dim> &mesh, const GhostLayers layers)
  {
    using Ghosts = std::vector<Ghost>;
    std::vector<std::pair<LocalIndex, Ghosts>> received;
    dealii::GridTools::exchange_cell_data_to_ghosts<Ghosts, dealii::Triangulation<dim>>(
      mesh.triangulation,
      [&](const Cell &cell) -> dealii::std_cxx17::optional<Ghosts> {
        const auto touching = cells_around(cell);
        const auto own      = material[node_of(cell)];
        if (layers == GhostLayers::one &&
            std::all_of(touching.begin(), touching.end(), [&](LocalIndex i) { return material[i] == own; }))
          return {};
        Ghosts result;
        for (const LocalIndex i : touching)
          result.emplace_back(global_number(i), std::make_pair(position[i], material[i]));
        return result;
      },
      [&](const Cell &cell, const Ghosts &ghosts) { received.emplace_back(node_of(cell), ghosts); });
    for (const auto &list : received)
      {
        auto &of_ghost = around.ghost[list.first];
        for (const Ghost &ghost : list.second)
          of_ghost.push_back(add_ghost(ghost));
      }
  }

  template <int dim>
  void CellGraph<dim>::sort_ghosts()
  {
    std::vector<LocalIndex> order(ghost_number.size()), place(n_local());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const LocalIndex a, const LocalIndex b) {
      return ghost_number[a] < ghost_number[b];
    });
    std::iota(place.begin(), place.end(), 0);
    for (LocalIndex g = 0; g < order.size(); ++g)
      place[n_owned_nodes + order[g]] = n_owned_nodes + g;
    const auto reorder = [&](auto &list, const LocalIndex first) {
      const auto before = list;
      for (LocalIndex g = 0; g < order.size(); ++g)
        list[first + g] = before[first + order[g]];
    };
    reorder(ghost_number, 0);
    reorder(position, n_owned_nodes);
    reorder(material, n_owned_nodes);
    const auto renumber = [&](std::vector<LocalIndex> &nodes) {
      for (LocalIndex &node : nodes)
        // Cells of other ranks that are no ghosts have none.
        if (node < n_local())
          node = place[node];
    };
    renumber(node_of_cell);
    renumber(cells);
    std::map<LocalIndex, std::vector<LocalIndex>> of_ghosts;
    for (auto &[node, list] : around.ghost)
      {
        renumber(list);
        std::sort(list.begin(), list.end());
        of_ghosts[place[node]] = std::move(list);
      }
    around.ghost = std::move(of_ghosts);
  }

  template <int dim>
  void CellGraph<dim>::forget_neighbours()
  {
    around = {};
    first  = {};
    cells  = {};
  }

  template <int dim>
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
  CellGraph<dim>::make_partitioner(const unsigned int n_components) const
  {
    return make_node_partitioner(
      first_global, n_owned_nodes, n_global, ghost_number, n_components, communicator);
  }

  template <int dim>
  std::size_t CellGraph<dim>::memory_consumption() const
  {
    return position.size() * (sizeof(position[0]) + sizeof(material[0])) +
           node_of_cell.size() * sizeof(LocalIndex) + first.size() * sizeof(unsigned int) +
           cells.size() * sizeof(LocalIndex);
  }

  PERIDEAL_INSTANTIATE_CLASS(CellGraph)
} // namespace perideal
