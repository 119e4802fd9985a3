// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_cell_shares_h
#define perideal_operators_weights_cell_shares_h

#include <perideal/base/types.h>

#include <vector>

namespace perideal
{
  /// The share of the consistent form in the energy of cells, by local node; one until it is set. The rest is
  /// that of bonds, where cracks may grow (FractureZone).
  class CellShares
  {
  public:
    double of(const LocalIndex i) const { return share.empty() ? 1. : share[i]; }
    /// Of a bond, the mean of its ends.
    double of_bond(const LocalIndex i, const LocalIndex j) const { return 0.5 * (of(i) + of(j)); }

    void set(const std::vector<double> &of_nodes) { share = of_nodes; }

    std::size_t memory_consumption() const { return share.size() * sizeof(double); }

  private:
    std::vector<double> share;
  };
} // namespace perideal

#endif
