// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/neighbourhood/bond_list.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace perideal
{
  template <int dim>
  BondList::BondList(const Families<dim> &families)
  {
    row.reserve(families.n_owned() + 1);
    row.push_back(0);
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        // Neighbours are sorted, so the bonds of this row are the tail of the family.
        const LocalIndex *first = std::upper_bound(families.begin(i), families.end(i), i);
        neighbour.insert(neighbour.end(), first, families.end(i));
        while (neighbour.size() % n_lanes != 0)
          neighbour.push_back(i);
        row.push_back(neighbour.size());
      }
    neighbour.shrink_to_fit();
  }

  BondIndex BondList::find(const LocalIndex i, const LocalIndex j) const
  {
    // A bond of owned nodes stands in the row of the lower one.
    const LocalIndex near = std::min(i, j), far = std::max(i, j);
    const auto       begin = neighbour.begin() + row[near];
    auto             end   = neighbour.begin() + row[near + 1];
    while (end != begin && *(end - 1) == near) // padding
      --end;
    const auto at = std::lower_bound(begin, end, far);
    return at != end && *at == far ? at - neighbour.begin() : no_slot;
  }

  LocalIndex BondList::near_end(const BondIndex slot) const
  {
    return std::upper_bound(row.begin(), row.end(), slot) - 1 - row.begin();
  }

  std::size_t BondList::memory_consumption() const
  {
    return dealii::MemoryConsumption::memory_consumption(row) +
           dealii::MemoryConsumption::memory_consumption(neighbour);
  }

  BondCursor::BondCursor(const BondList &bonds)
    : bonds(bonds)
    , next(bonds.row.begin(), bonds.row.end() - 1)
  {
  }

  void BondCursor::find(const LocalIndex  i,
                        const LocalIndex *begin,
                        const LocalIndex *end,
                        std::vector<End> &result)
  {
    result.resize(end - begin);
    BondIndex own = bonds.row[i];
    for (End &place : result)
      {
        // Row j lists i after all lower numbers, which were visited before.
        const LocalIndex j = *begin++;
        place              = j < i ? End{next[j]++, false} : End{own++, true};
      }
  }

  template <int dim>
  void exchange_cut_bonds(const Families<dim>               &families,
                          const BondList                    &bonds,
                          const std::vector<const double *> &near,
                          const std::vector<double *>       &far,
                          const std::vector<LocalIndex>     &place)
  {
    const LocalIndex n_owned = families.n_owned();
    const auto       at = [&](const BondIndex slot) { return place.empty() ? slot : BondIndex(place[slot]); };
    if (dealii::Utilities::MPI::n_mpi_processes(families.communicator) == 1)
      return;

    // Both sides agree on the order: by the sender's node, then by the
    // receiver's, both ascending, which here is by row and within a row.
    std::map<unsigned int, std::vector<double>> outbox;
    std::vector<std::vector<BondIndex>>         slots_of_ghost(families.n_local() - n_owned);
    for (LocalIndex i = 0; i < n_owned; ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] >= n_owned)
          {
            const LocalIndex ghost = bonds.neighbour[slot] - n_owned;
            slots_of_ghost[ghost].push_back(slot);
            auto &message = outbox[families.ghost_owner[ghost]];
            for (const double *values : near)
              message.push_back(values[at(slot)]);
          }

    const auto inbox = dealii::Utilities::MPI::some_to_some(families.communicator, outbox);
    std::map<unsigned int, const double *> position;
    for (const auto &message : inbox)
      position[message.first] = message.second.data();
    for (LocalIndex ghost = 0; ghost < slots_of_ghost.size(); ++ghost)
      {
        const double *&value = position[families.ghost_owner[ghost]];
        for (const BondIndex slot : slots_of_ghost[ghost])
          for (double *values : far)
            values[at(slot)] = *value++;
      }
  }

  PERIDEAL_INSTANTIATE(exchange_cut_bonds)
  template BondList::BondList(const Families<2> &);
  template BondList::BondList(const Families<3> &);
} // namespace perideal
