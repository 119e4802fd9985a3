// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_rest_regions_h
#define perideal_operators_force_rest_regions_h

#include <perideal/base/types.h>
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/neighbourhood/families.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace perideal
{
  /**
   * Knows which rows of a bond list have anything to compute, in blocks of consecutive
   * rows: where a node and all its neighbours are still exactly where they were, forces are
   * exactly zero. A block that a wave has reached stays awake.
   */
  class RestRegions
  {
  public:
    static constexpr LocalIndex block_size = 16;

    /// @param through_states forces follow from states of the neighbours, which follow from theirs
    template <int dim>
    RestRegions(const Families<dim> &families, const BondList &bonds, const bool through_states);

    /// Looks for motion in the blocks that were at rest. Collective.
    /// @param has_moved of a local node @param visit_nodes calls its argument with those that may have begun
    /// to move @param is_whole whether these are all: a step of its own, which counts
    template <typename HasMoved, typename VisitNodes>
    void update(const HasMoved &has_moved, const VisitNodes &visit_nodes, const bool is_whole);

    /// From now on computes what nodes that count and their neighbours need, whatever moves. Collective.
    /// @param counts of a local node
    void keep_awake(const std::function<bool(const LocalIndex)> &counts);

    bool sums_awake(const LocalIndex block) const { return in_sums[block] != 0; }
    bool forces_awake(const LocalIndex block) const { return in_forces[block] != 0; }

    /// Calls visit(j) with the owned nodes whose rows may hold node @p i as their far end.
    template <typename Visit>
    void visit_rows_with(const LocalIndex i, const Visit &visit) const
    {
      for (const LocalIndex block : neighbours.blocks[block_of(i)])
        for (LocalIndex j = block * block_size; block < n_row_blocks && j < (block + 1) * block_size && j < i;
             ++j)
          visit(j);
    }

    std::size_t memory_consumption() const;

    /// Mean share of the bonds of all ranks that were awake in update(). Collective.
    double share_awake() const;

  private:
    LocalIndex block_of(const LocalIndex node) const;
    void       spread();
    void       look_for_sleepers();

    LocalIndex n_owned, n_local, n_row_blocks;
    bool       through_states;
    MPI_Comm   communicator;
    bool       all_awake = false;

    /// Slots of all updates so far.
    struct Counts
    {
      double awake = 0, all = 0;
    };
    Counts computed;

    /// Blocks of owned rows, then of ghosts.
    std::vector<std::uint8_t> moved, in_sums, in_forces;

    /// Of each row block, the blocks that hold its neighbours, and whether ghosts are among these.
    struct Neighbours
    {
      std::vector<std::vector<LocalIndex>> blocks;
      std::vector<std::uint8_t>            are_ghosts;
    };
    Neighbours             neighbours;
    std::vector<BondIndex> slots;
  };

  template <typename HasMoved, typename VisitNodes>
  void RestRegions::update(const HasMoved &has_moved, const VisitNodes &visit_nodes, const bool is_whole)
  {
    if (!all_awake)
      {
        bool begins = is_whole;
        visit_nodes([&](const LocalIndex i) {
          if (!moved[block_of(i)] && has_moved(i))
            moved[block_of(i)] = begins = true;
        });
        if (begins)
          spread();
        look_for_sleepers();
      }
    for (LocalIndex block = 0; block < n_row_blocks && is_whole; ++block)
      {
        computed.all += slots[block];
        computed.awake += in_forces[block] ? slots[block] : 0;
      }
  }
} // namespace perideal

#endif
