// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_nodes_cell_graph_h
#define perideal_nodes_cell_graph_h

#include <perideal/base/record_exchange.h>
#include <perideal/mesh/mesh.h>
#include <perideal/nodes/nodes.h>

#include <deal.II/base/partitioner.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace perideal
{
  /// How many layers of cells of other ranks a graph knows: those that touch its own, where another material
  /// lies beside these also what touches them; or always.
  enum class GhostLayers
  {
    one,
    two
  };

  /**
   * Knows the nodes of this rank's cells and of the cells around them, and which of
   * them meet at each vertex of the mesh.
   *
   * Local numbers: owned nodes first, as in the cloud, then ghosts in the order of their global numbers, as
   * in layouts of fields. They differ from those of Families, whose halo follows the horizon.
   */
  template <int dim>
  class CellGraph
  {
  public:
    using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;

    /// Collective.
    CellGraph(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const GhostLayers layers = GhostLayers::one);

    LocalIndex n_owned() const { return n_owned_nodes; }
    LocalIndex n_local() const { return static_cast<LocalIndex>(position.size()); }

    GlobalIndex global_number(const LocalIndex i) const
    {
      return i < n_owned_nodes ? first_global + i : ghost_number[i - n_owned_nodes];
    }

    /// Node of an owned or ghost cell.
    LocalIndex node_of(const Cell &cell) const { return node_of_cell[cell->active_cell_index()]; }

    /// Adds the nodes of the cells that touch a vertex, those that it hangs on included.
    void add_cells_at(const unsigned int vertex, std::vector<LocalIndex> &list) const
    {
      list.insert(list.end(), cells.begin() + first[vertex], cells.begin() + first[vertex + 1]);
    }

    /// Nodes of the cells that share a vertex with a cell, its own included,
    /// ascending. For owned cells, and for ghosts around which a second layer is known.
    std::vector<LocalIndex> cells_around(const Cell &cell) const;

    /// The same by node, of graphs of two layers.
    const std::vector<LocalIndex> &nodes_around(const LocalIndex node) const
    {
      return node < n_owned_nodes ? around.owned[node] : around.ghost.at(node);
    }

    /// Frees what cells_around(), nodes_around() and add_cells_at() need.
    void forget_neighbours();

    /// The values of all local nodes from those of the owned ones, for types made of
    /// doubles such as tensors. Collective.
    template <typename Value>
    std::vector<Value> with_ghosts(std::vector<Value> owned) const;

    /// Adds what the ranks have for each other's nodes: values of local nodes in,
    /// those of owned ones out. Collective.
    template <typename Value>
    std::vector<Value> sum_to_owners(const std::vector<Value> &local) const;

    /// Layout of a field with @p n_components values a node; ghosts as here.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
    make_partitioner(const unsigned int n_components) const;

    /// Centroids [m] and materials of local nodes, ghosts included.
    std::vector<dealii::Point<dim>>         position;
    std::vector<dealii::types::material_id> material;
    /// Global numbers of the ghosts, ascending.
    std::vector<GlobalIndex> ghost_number;

    MPI_Comm communicator;

    /// Bytes held on this rank.
    std::size_t memory_consumption() const;

  private:
    /// What ranks tell each other of a node.
    using Ghost = std::pair<GlobalIndex, std::pair<dealii::Point<dim>, dealii::types::material_id>>;

    LocalIndex add_ghost(const Ghost &ghost);
    void       exchange_ghosts(const Mesh<dim> &mesh);
    void       collect_cells_at_vertices(const Mesh<dim> &mesh);
    void       exchange_second_layer(const Mesh<dim> &mesh, const GhostLayers layers);
    void       sort_ghosts();

    LocalIndex              n_owned_nodes;
    GlobalIndex             first_global, n_global;
    std::vector<LocalIndex> node_of_cell;
    /// Cells at each vertex.
    std::vector<unsigned int> first;
    std::vector<LocalIndex>   cells;
    /// cells_around() of ghosts of which a second layer is known, and of owned cells of graphs of two layers.
    struct Around
    {
      std::map<LocalIndex, std::vector<LocalIndex>> ghost;
      std::vector<std::vector<LocalIndex>>          owned;
    };
    Around                            around;
    std::map<GlobalIndex, LocalIndex> local_number_of_ghost;
  };

  template <int dim>
  template <typename Value>
  std::vector<Value> CellGraph<dim>::with_ghosts(std::vector<Value> owned) const
  {
    constexpr unsigned int n = sizeof(Value) / sizeof(double);
    AssertDimension(owned.size(), n_owned_nodes);
    owned.resize(n_local());
    const auto          layout = make_partitioner(n);
    std::vector<double> buffer;
    update_ghosts(*layout, reinterpret_cast<double *>(owned.data()), buffer);
    return owned;
  }

  template <int dim>
  template <typename Value>
  std::vector<Value> CellGraph<dim>::sum_to_owners(const std::vector<Value> &local) const
  {
    constexpr unsigned int n = sizeof(Value) / sizeof(double);
    AssertDimension(local.size(), n_local());
    NodalVector field(make_partitioner(n));
    for (LocalIndex i = 0; i < n_local(); ++i)
      for (unsigned int c = 0; c < n; ++c)
        field(n * global_number(i) + c) = reinterpret_cast<const double *>(&local[i])[c];
    field.compress(dealii::VectorOperation::add);
    std::vector<Value> result(n_owned_nodes);
    std::copy_n(field.begin(), n * n_owned_nodes, reinterpret_cast<double *>(result.data()));
    return result;
  }
} // namespace perideal

#endif
