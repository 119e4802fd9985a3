// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_components_h
#define perideal_neighbourhood_components_h

#include <perideal/neighbourhood/bond_list.h>

#include <boost/pending/disjoint_sets.hpp>

#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace perideal
{
  /// Collects things, numbered from 0, in connected components as links between them become known.
  class Components
  {
  public:
    explicit Components(const unsigned int n_things)
      : n_things(n_things)
      , sets(n_things)
    {
    }

    void join(const unsigned int a, const unsigned int b) { sets.union_set(a, b); }

    /// Joins by the links of all ranks. Collective.
    void join_all(const std::set<std::pair<unsigned int, unsigned int>> &links, MPI_Comm communicator);

    /// The component of each thing, and how many there are; components are numbered by their first things.
    std::pair<std::vector<unsigned int>, unsigned int> number();

  private:
    unsigned int                        n_things;
    boost::disjoint_sets_with_storage<> sets;
  };

  /**
   * Finds the connected components of the nodes of all ranks: of each owned node, the smallest global number
   * of a node that a chain of links leads to. Collective.
   * @param links whether the bond of owned node i, of the same or another rank's node j, in a slot is a link;
   *   a bond between ranks is one when either of them says so
   */
  template <int dim>
  std::vector<GlobalIndex>
  find_components(const Families<dim> &families,
                  const BondList      &bonds,
                  const std::function<bool(const LocalIndex, const LocalIndex, const BondIndex slot)> &links);
} // namespace perideal

#endif
