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
    /// @param has_moved of a local node
    template <typename HasMoved>
    void update(const HasMoved &has_moved);

    /// As update(), where no others than some owned nodes and the ghosts may have begun to move. Collective.
    template <typename HasMoved>
    void update(const HasMoved &has_moved, const std::vector<LocalIndex> &nodes);

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
    /// Looks for motion that begins, and wakes what it reaches. Collective.
    template <typename HasMoved, typename Nodes>
    void wake(const HasMoved &has_moved, const Nodes &visit_nodes);
    void spread();
    void look_for_sleepers();

    LocalIndex n_owned, n_local, n_row_blocks;
    bool       through_states;
    MPI_Comm   communicator;
    bool       all_awake = false, has_spread = false;

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

  template <typename HasMoved>
  void RestRegions::update(const HasMoved &has_moved)
  {
    double awake = 0, all = 0;
    wake(has_moved, [&](const auto &look) {
      for (LocalIndex i = 0; i < n_local; ++i)
        look(i);
    });
    for (LocalIndex block = 0; block < n_row_blocks; ++block)
      {
        all += slots[block];
        awake += in_forces[block] ? slots[block] : 0;
      }
    computed.all += all;
    computed.awake += awake;
  }

  template <typename HasMoved>
  void RestRegions::update(const HasMoved &has_moved, const std::vector<LocalIndex> &nodes)
  {
    wake(has_moved, [&](const auto &look) {
      for (const LocalIndex i : nodes)
        look(i);
      for (LocalIndex i = n_owned; i < n_local; ++i)
        look(i);
    });
  }

  template <typename HasMoved, typename Nodes>
  void RestRegions::wake(const HasMoved &has_moved, const Nodes &visit_nodes)
  {
    if (all_awake)
      return;
    bool begins = false;
    visit_nodes([&](const LocalIndex i) {
      if (!moved[block_of(i)] && has_moved(i))
        moved[block_of(i)] = begins = true;
    });
    if (begins || !has_spread)
      spread();
    look_for_sleepers();
  }
} // namespace perideal

#endif
