// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_nodes_mesh_points_h
#define perideal_nodes_mesh_points_h

#include <perideal/nodes/cell_graph.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace perideal
{
  /// A vector at each corner of a cell, in deal.II's order of vertices.
  template <int dim>
  using CornerValues = std::array<dealii::Tensor<1, dim>, (1 << dim)>;

  /**
   * Numbers the points at which the cells of a body meet, for fields that are continuous but for cracks: one
   * at each vertex of the mesh, and where cracks run through a vertex, one for each group of its cells that
   * still hang together through faces. Points are numbered alike on all ranks, those of each rank in a row.
   *
   * Of cells of different sizes the vertices of the smaller ones hang on an edge or face of the larger one;
   * mean() puts them there, so that no gap opens.
   */
  template <int dim>
  class MeshPoints
  {
  public:
    static constexpr unsigned int n_corners = 1 << dim;
    using Cell                              = typename CellGraph<dim>::Cell;
    using Numbers                           = std::array<GlobalIndex, n_corners>;

    /// A corner of a cell by the cell's node, local number of the graph.
    struct Corner
    {
      LocalIndex   node;
      unsigned int corner;
    };

    /// Cells that hang together at a vertex.
    struct Group
    {
      /// Those that have the vertex for a corner, by the global number of their nodes.
      std::vector<Corner> corners;
      /// Larger ones on which the vertex hangs.
      std::vector<LocalIndex> larger;
    };

    /// Numbers the points of a body whose faces are all whole. The mesh must outlive this object, and stay as
    /// it is. Collective.
    MeshPoints(const Mesh<dim> &mesh, const std::shared_ptr<const CellGraph<dim>> &graph);

    /// Whether a crack runs between an owned node and one whose cell shares a face with its own.
    using IsOpen = std::function<bool(const LocalIndex, const LocalIndex)>;

    /// Opens these faces and no others, and numbers the points anew. Collective.
    void open(const IsOpen &is_open);

    /// Points at the corners of the owned cells, by node.
    const std::vector<Numbers> &numbers() const { return number; }

    /// This rank's points in the order of their numbers, each by one of its cells.
    const std::vector<Corner> &own_points() const { return own; }

    /// Number of points of all ranks.
    GlobalIndex n_points() const { return n_of_all; }

    /// Nodes of the cells that share a point with an owned cell, its own included, ascending.
    std::vector<LocalIndex> cells_around(const LocalIndex node) const;

    /// Returns the mean of the cells' values at each point, by owned node. Collective.
    std::vector<CornerValues<dim>> mean(std::vector<CornerValues<dim>> values) const;

    const CellGraph<dim> &graph() const { return *cells; }

    /// The cell of a local node.
    Cell cell(const LocalIndex node) const
    {
      return Cell(&mesh.triangulation, place[node].first, place[node].second);
    }

  private:
    /// Calls visit(vertex, group, number of groups there) for each group of cells at the vertices of owned
    /// cells.
    template <typename Visit>
    void visit_groups(const Visit &visit) const;

    /// The groups of cells at a vertex.
    void find_groups(const unsigned int vertex, std::vector<Group> &groups) const;

    /// The node behind a face of a cell of the same size or a smaller one; none where there is not one.
    LocalIndex                  behind(const Cell &cell, const unsigned int face) const;
    static constexpr LocalIndex none = static_cast<LocalIndex>(-1);

    /// Returns what a vertex that hangs on a cell has of the values at the cell's corners.
    dealii::Tensor<1, dim>
    on_larger(const LocalIndex node, const unsigned int vertex, const CornerValues<dim> &values) const;

    void number_points();

    const Mesh<dim>                      &mesh;
    std::shared_ptr<const CellGraph<dim>> cells;
    /// Level and index of the cells of local nodes.
    std::vector<std::pair<int, int>> place;
    /// A bit for each open face, by local node; empty: none is open.
    std::vector<unsigned char> open_faces;
    std::vector<Numbers>       number;
    std::vector<Corner>        own;
    GlobalIndex                n_of_all = 0;
    /// Whether vertices hang on larger cells.
    bool is_uneven = false;
    /// cells_around() of owned nodes at cracks.
    std::map<LocalIndex, std::vector<LocalIndex>> around;
  };
} // namespace perideal

#endif
