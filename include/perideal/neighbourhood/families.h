// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_families_h
#define perideal_neighbourhood_families_h

#include <perideal/nodes/nodes.h>

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace perideal
{
  template <int dim>
  class VolumeRule;

  /**
   * Finds the families of the nodes of this rank by the union rule: j belongs to the
   * family of i when it lies within the horizon of i or i within that of j, for
   * spheres |x_j - x_i| <= max(horizon_i, horizon_j), so that every
   * bond has two ends (XOSB eq. 71). Where the cloud knows how far cells reach, families hold the cells that
   * horizons cut: those of which a volume rule counts a share, at either end.
   *
   * Families may list the members within a share of their horizons only, and whole families be made from them
   * where they are needed, in an object of its own with the same local numbers.
   *
   * Local numbers, by which the arrays of the nodes go: owned nodes first, as in the cloud, then ghosts, the
   * nodes of other ranks that share a bond with an owned one, by ascending global number.
   */
  template <int dim>
  class Families : public NodeArrays<dim>
  {
  public:
    using NodeArrays<dim>::position;
    using NodeArrays<dim>::volume;
    using NodeArrays<dim>::horizon;
    using NodeArrays<dim>::material;
    using NodeArrays<dim>::shape;
    using NodeArrays<dim>::spacing;
    using NodeArrays<dim>::finest;
    using NodeArrays<dim>::cell_radius;
    using NodeArrays<dim>::cell;
    using NodeArrays<dim>::margin;

    /// Exchanges the halo and searches. Collective.
    /// @param rule how much of its members' volumes a family counts; null: all
    /// @param listed up to which share of horizons members are listed [-]; ghosts are those of whole ones
    explicit Families(const NodeCloud<dim>                         &nodes,
                      const std::shared_ptr<const VolumeRule<dim>> &rule   = nullptr,
                      const double                                  listed = 1.);

    /// Returns the same nodes with the whole families of some, in place of what is listed here: bonds with at
    /// least one end among them. Collective.
    /// @param chosen by local node, of all ranks alike
    std::shared_ptr<const Families> whole_families(const std::vector<bool> &chosen) const;

    /// Returns these nodes and the members of their whole families, by local node. Collective.
    /// @param chosen by local node; of ghosts their owners decide
    std::vector<bool> with_members(const std::vector<bool> &chosen) const;

    /// Returns those of the chosen nodes of which all members are chosen, by local node. Collective.
    /// @param chosen by local node, of all ranks alike
    std::vector<bool> with_all_members(const std::vector<bool> &chosen) const;

    /// Whether all members of an owned node are listed.
    bool is_whole(const LocalIndex i) const
    {
      return what_is_listed.whole.empty() ? what_is_listed.share == 1. : what_is_listed.whole[i];
    }

    /// Up to which share of horizons members are listed [-].
    double listed() const { return what_is_listed.share; }

    /// Whether two local nodes are members of each other's whole families.
    bool are_members(const LocalIndex i, const LocalIndex j) const;

    LocalIndex n_owned() const { return n_owned_nodes; }
    LocalIndex n_local() const { return static_cast<LocalIndex>(position.size()); }

    /// Neighbours of an owned node, ascending: [begin(i), end(i)).
    const LocalIndex *begin(const LocalIndex i) const { return neighbour.data() + row[i]; }
    const LocalIndex *end(const LocalIndex i) const { return neighbour.data() + row[i + 1]; }
    LocalIndex        size(const LocalIndex i) const { return static_cast<LocalIndex>(row[i + 1] - row[i]); }

    /// Number of undirected bonds of all ranks.
    GlobalIndex n_bonds() const { return n_bonds_of_all; }

    struct Statistics
    {
      LocalIndex min = 0, max = 0;
      double     mean = 0;
    };
    /// Family sizes over all ranks.
    Statistics statistics() const { return sizes; }

    /// Releases the lists of members, which take the most memory: begin() and end() must not be called after
    /// this, size() may.
    void release_members();

    /// Global number of a local node.
    GlobalIndex global_number(const LocalIndex i) const
    {
      return i < n_owned_nodes ? first_global + i : ghost_number[i - n_owned_nodes];
    }

    /// Layout of a field with @p n_components values a node; ghosts as here.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
    make_partitioner(const unsigned int n_components) const;

    /// Bytes held on this rank.
    std::size_t memory_consumption() const;

    /// How much of members' volumes counts; null: all. volume_share() asks it.
    std::shared_ptr<const VolumeRule<dim>> volume_rule;

    /// Global numbers of the ghosts, ascending, and the rank that owns each.
    std::vector<GlobalIndex>  ghost_number;
    std::vector<unsigned int> ghost_owner;

    MPI_Comm communicator;

  private:
    void search(const NodeCloud<dim> &nodes);
    /// Whether one of two local nodes is within a share of the other's horizon.
    bool are_within(const LocalIndex i, const LocalIndex j, const double share) const;
    /// @param used by ghost
    void drop_unused_ghosts(const std::vector<bool> &used);
    void count();

    /// Calls visit(i, j) for each chosen local node i and each local j of its whole family; of ghosts for
    /// those members that are owned.
    template <typename Visit>
    void visit_members(const std::vector<bool> &chosen, const Visit &visit) const;

    LocalIndex              n_owned_nodes;
    GlobalIndex             first_global, n_global;
    std::vector<BondIndex>  row;
    std::vector<LocalIndex> neighbour;
    /// What of the families is listed: members up to a share of horizons, or whole families of owned nodes,
    /// where this is not empty.
    struct Listed
    {
      double            share = 1.;
      std::vector<bool> whole;
    };
    Listed      what_is_listed;
    GlobalIndex n_bonds_of_all = 0;
    Statistics  sizes;
  };
} // namespace perideal

#endif
