// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/floating_nodes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// 1 at owned nodes with that many held components at least, else 0.
    template <int dim>
    std::vector<LocalIndex>
    held_nodes(const LocalIndex n_owned, const std::vector<std::uint8_t> &held, const int at_least)
    {
      std::vector<LocalIndex> result;
      for (LocalIndex i = 0; i < n_owned; ++i)
        if (std::count_if(held.begin() + dim * i, held.begin() + dim * (i + 1), [](const auto h) {
              return h != 0;
            }) >= at_least)
          result.push_back(i);
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<bool> find_floating_nodes(const Families<dim>                        &families,
                                        const BondList                             &bonds,
                                        const std::function<bool(const BondIndex)> &is_lost,
                                        const std::vector<std::uint8_t>            &held)
  {
    const LocalIndex n_owned = families.n_owned();
    const auto       exist   = [&](const std::vector<LocalIndex> &nodes) {
      return dealii::Utilities::MPI::max(nodes.empty() ? 0 : 1, families.communicator) == 1;
    };
    std::vector<LocalIndex> queue = held_nodes<dim>(n_owned, held, dim);
    if (!exist(queue))
      queue = held_nodes<dim>(n_owned, held, 1);
    std::vector<bool> floats(n_owned, false);
    if (!exist(queue))
      return floats;

    // From node to node along bonds, and from rank to rank through ghosts, until nothing new is reached.
    NodalVector reached(families.make_partitioner(1));
    for (const LocalIndex i : queue)
      reached.local_element(i) = 1.;
    unsigned int changed = 1;
    while (changed > 0)
      {
        changed = 0;
        while (!queue.empty())
          {
            const LocalIndex i = queue.back();
            queue.pop_back();
            for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
              if (*j < n_owned && reached.local_element(*j) == 0. && !is_lost(bonds.find(i, *j)))
                {
                  reached.local_element(*j) = 1.;
                  queue.push_back(*j);
                }
          }
        reached.update_ghost_values();
        for (LocalIndex i = 0; i < n_owned; ++i)
          if (reached.local_element(i) == 0.)
            for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
              if (*j >= n_owned && reached.local_element(*j) != 0. && !is_lost(bonds.find(i, *j)))
                {
                  queue.push_back(i);
                  changed = 1;
                  break;
                }
        reached.zero_out_ghost_values();
        for (const LocalIndex i : queue)
          reached.local_element(i) = 1.;
        changed = dealii::Utilities::MPI::max(changed, families.communicator);
      }
    for (LocalIndex i = 0; i < n_owned; ++i)
      floats[i] = reached.local_element(i) == 0.;
    return floats;
  }

  PERIDEAL_INSTANTIATE(find_floating_nodes)
} // namespace perideal
