// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_nodes_nodes_h
#define perideal_nodes_nodes_h

#include <perideal/base/types.h>
#include <perideal/geometry/cell_vertices.h>
#include <perideal/mesh/mesh.h>
#include <perideal/parameters/choice.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <vector>

namespace perideal
{
  /// Whether horizons are spheres or have the shape of the cells.
  enum class HorizonShape
  {
    automatic,
    sphere,
    cell
  };

  template <>
  struct ChoiceNames<HorizonShape>
  {
    static constexpr const char *list[] = {"automatic", "sphere", "cell"};
  };

  /// Section "Nodes".
  struct NodeParameters
  {
    /// Horizon of a node over its spacing [-].
    double       horizon_factor = 3.01;
    HorizonShape horizon_shape  = HorizonShape::automatic;
    /// How far nodes lie off the centroids, over the edges of their cells: at most half of this [-].
    double perturbation = 0.;
    /// Whether identical families share their weights, which are then computed and stored once.
    bool share_equal_families = true;
    /// Whether the consistent form makes whole families where cracks come near only.
    bool families_on_demand = true;

    void declare(dealii::ParameterHandler &prm);
    /// @throws InputError when the factor cannot make families, or a perturbation takes nodes out of cells.
    void check() const;
  };

  /// Holds what is known of each node, in arrays by its local number.
  template <int dim>
  struct NodeArrays
  {
    /// Where the nodes are [m]; centroids of cells, unless they were perturbed.
    std::vector<dealii::Point<dim>> position;
    /// Volumes, in 2-D area times thickness [m^3].
    std::vector<double> volume;
    /// Edge length of the square or cube of equal measure [m].
    std::vector<double> spacing;
    /// Share of itself that the spacing may come to as the mesh adapts [-]. Empty: the mesh stays.
    std::vector<double> finest;
    /// Horizon factor times spacing [m]: the radius of a spherical horizon, and
    /// of the sphere with the volume of one that has the shape of the cell.
    std::vector<double> horizon;
    /// The shape of the horizon, a map to the unit sphere: xi is within when
    /// |shape xi| <= 1 [1/m]. Empty where all horizons are spheres.
    std::vector<dealii::Tensor<2, dim>> shape;
    /// Material (cell group) of the node.
    std::vector<dealii::types::material_id> material;
    /// How far cells reach beyond their nodes [m], where the cells that a horizon cuts belong to the family.
    /// Empty: families hold the nodes within horizons.
    std::vector<double> cell_radius;
    /// The nodes' cells; empty where no volume rule needs them.
    std::vector<CellVertices<dim>> cell;
    /// The largest cell_radius over the horizon of all ranks [-].
    double margin = 0;

    /// How far the search looks from node @p i along each axis [m]: its horizon, and where families hold
    /// cells that horizons cut, far enough for these.
    dealii::Tensor<1, dim> reach(const LocalIndex i) const;

    /// Horizon of the smallest cells that a node's own may be halved to [m]. Bonds fail by it: larger cells
    /// are halved before theirs do.
    double finest_horizon(const LocalIndex i) const { return horizon[i] * finest_share(i); }
    double finest_share(const LocalIndex i) const { return finest.empty() ? 1. : finest[i]; }

    /// A hair by which spherical horizons are larger, so that on regular meshes the nodes at the rim of a
    /// horizon of whole cells are members, whatever way they are rounded.
    static constexpr double round_off = 1e-9;
  };

  /**
   * Holds the peridynamic nodes of this rank: what the neighbour search and the materials
   * need of them. Arrays are indexed by the node's local number.
   */
  template <int dim>
  struct NodeCloud : NodeArrays<dim>
  {
    using NodeArrays<dim>::position;
    using NodeArrays<dim>::horizon;
    using NodeArrays<dim>::shape;
    using NodeArrays<dim>::cell_radius;
    using NodeArrays<dim>::margin;

    LocalIndex size() const { return static_cast<LocalIndex>(position.size()); }

    /// Sets first_global and n_global from the sizes on all ranks. Collective.
    void number();

    /// Sets cell_radius and what follows from it. Horizons must be spheres. Collective.
    void set_cell_radius(std::vector<double> radius);

    /// Whether neighbours need to know cells. The same on all ranks.
    bool has_cells = false;

    /// Global number of this rank's first node; the rank's nodes are contiguous.
    GlobalIndex first_global = 0;
    /// Number of nodes of all ranks.
    GlobalIndex n_global = 0;

    MPI_Comm communicator = MPI_COMM_NULL;
  };

  /**
   * Creates the nodes of a mesh, one for every locally owned cell, ordered along a
   * space-filling curve so that families lie close in memory.
   */
  template <int dim>
  struct Nodes : NodeCloud<dim>
  {
    /// @throws InputError on a horizon factor outside its range.
    Nodes(const Mesh<dim> &mesh, const NodeParameters &parameters);

    /// Local node of a locally owned active cell, by active_cell_index();
    /// dealii::numbers::invalid_unsigned_int for other cells.
    std::vector<LocalIndex> node_of_cell;

    /// How far the cells of the owned nodes reach beyond these [m].
    std::vector<double> cell_radii(const Mesh<dim> &mesh) const;

    /// Keeps the vertices of the nodes' cells, to which families then reach. Collective.
    void keep_cells(const Mesh<dim> &mesh);

    /// Longest over shortest edge of the cells of all ranks.
    double mean_aspect_ratio = 1, max_aspect_ratio = 1;

  private:
    void choose_shape(const Mesh<dim> &mesh, const NodeParameters &parameters);

    /// Moves each node along the edges of its cell, by eta times their length times a number from -1/2 to 1/2
    /// that depends on the cell alone. (VNOSB eq. (24) has numbers from 0 to 1, which moves the cloud as a
    /// whole by half a perturbation off the body.)
    void perturb(const Mesh<dim> &mesh, const double eta);
  };
} // namespace perideal

#endif
