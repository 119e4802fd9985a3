// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_bond_list_h
#define perideal_neighbourhood_bond_list_h

#include <perideal/neighbourhood/families.h>

#include <vector>

namespace perideal
{
  /**
   * Lists every bond of this rank once: row i holds the bonds of owned node i with
   * owned nodes of a higher number and with ghosts (a bond cut by the partition
   * stands on both ranks). The near end of a bond is its row's node.
   *
   * Rows are padded to whole groups of n_lanes slots, for loops over that many
   * bonds at once; a padding slot joins the node with itself, and whoever
   * stores values by slot stores zeros there.
   */
  class BondList
  {
  public:
    static constexpr unsigned int n_lanes = 4;

    template <int dim>
    explicit BondList(const Families<dim> &families);

    LocalIndex n_rows() const { return static_cast<LocalIndex>(row.size() - 1); }
    BondIndex  n_slots() const { return neighbour.size(); }

    static constexpr BondIndex no_slot = -1;
    /// Slot of the bond of an owned node with another local one; no_slot: there is none.
    BondIndex find(const LocalIndex i, const LocalIndex j) const;

    /// The row that holds a slot.
    LocalIndex near_end(const BondIndex slot) const;

    std::size_t memory_consumption() const;

    /// Slots of row i: [row[i], row[i+1]), a multiple of n_lanes.
    std::vector<BondIndex> row;
    /// The far end of each slot.
    std::vector<LocalIndex> neighbour;
  };

  /// The local numbers of the nodes of a bond; the near end is owned.
  struct BondEnds
  {
    LocalIndex near, far;
  };

  /**
   * Finds the slots of a family's bonds without searching: families must be
   * visited by ascending node, all of them.
   */
  class BondCursor
  {
  public:
    explicit BondCursor(const BondList &bonds);

    struct End
    {
      BondIndex slot;
      /// True when the family's node is the near end.
      bool is_near;
    };

    /// The slots of the family of @p i, whose sorted neighbours are given.
    void find(const LocalIndex i, const LocalIndex *begin, const LocalIndex *end, std::vector<End> &result);

  private:
    const BondList        &bonds;
    std::vector<BondIndex> next;
  };

  /**
   * Values that each rank computed for the near ends of its cut bonds are sent
   * to where they are the far ends. @p near and @p far are n_values arrays by
   * slot; far is written at slots that lead to ghosts. Collective.
   * @param place where the values of each slot stand in the arrays; empty: by slot
   */
  template <int dim>
  void exchange_cut_bonds(const Families<dim>               &families,
                          const BondList                    &bonds,
                          const std::vector<const double *> &near,
                          const std::vector<double *>       &far,
                          const std::vector<LocalIndex>     &place = {});
} // namespace perideal

#endif
