// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/rest_regions.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  RestRegions::RestRegions(const Families<dim> &families, const BondList &bonds, const bool through_states)
    : n_owned(families.n_owned())
    , n_local(families.n_local())
    , n_row_blocks((n_owned + block_size - 1) / block_size)
    , through_states(through_states)
    , communicator(families.communicator)
    , moved(n_row_blocks + (n_local - n_owned + block_size - 1) / block_size, 0)
    , in_sums(n_row_blocks, 0)
    , in_forces(n_row_blocks, 0)
    , neighbours{std::vector<std::vector<LocalIndex>>(n_row_blocks),
                 std::vector<std::uint8_t>(n_row_blocks, 0)}
    , slots(n_row_blocks, 0)
  {
    // Neighbours are sorted: most repetitions follow each other.
    const auto add = [](std::vector<LocalIndex> &list, const LocalIndex block) {
      if (list.empty() || list.back() != block)
        list.push_back(block);
    };
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        const LocalIndex block = i / block_size;
        slots[block] += bonds.row[i + 1] - bonds.row[i];
        for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
          {
            const LocalIndex other = block_of(bonds.neighbour[slot]);
            add(neighbours.blocks[block], other);
            if (other < n_row_blocks)
              add(neighbours.blocks[other], block);
            else
              neighbours.are_ghosts[block] = 1;
          }
      }
    for (auto &list : neighbours.blocks)
      {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        list.shrink_to_fit();
      }
  }

  void RestRegions::keep_awake(const std::function<bool(const LocalIndex)> &counts)
  {
    for (auto *blocks : {&moved, &in_sums, &in_forces})
      std::fill(blocks->begin(), blocks->end(), 0);
    for (LocalIndex i = 0; i < n_local; ++i)
      if (counts(i))
        moved[block_of(i)] = 1;
    spread();
    // Nothing else is looked for.
    all_awake = true;
  }

  LocalIndex RestRegions::block_of(const LocalIndex node) const
  {
    return node < n_owned ? node / block_size : n_row_blocks + (node - n_owned) / block_size;
  }

  void RestRegions::spread()
  {
    for (LocalIndex block = 0; block < n_row_blocks; ++block)
      if (!in_sums[block])
        in_sums[block] = moved[block] || std::any_of(neighbours.blocks[block].begin(),
                                                     neighbours.blocks[block].end(),
                                                     [&](const auto b) { return moved[b] != 0; });
    if (!through_states)
      in_forces = in_sums;
    else
      for (LocalIndex block = 0; block < n_row_blocks; ++block)
        // What states ghosts have, their owners know: forces beside them are always summed.
        if (!in_forces[block])
          in_forces[block] = in_sums[block] || neighbours.are_ghosts[block] ||
                             std::any_of(neighbours.blocks[block].begin(),
                                         neighbours.blocks[block].end(),
                                         [&](const auto b) { return b < n_row_blocks && in_sums[b] != 0; });
  }

  void RestRegions::look_for_sleepers()
  {
    const unsigned int asleep =
      std::any_of(in_sums.begin(), in_sums.end(), [](const auto a) { return a == 0; }) ||
      std::any_of(in_forces.begin(), in_forces.end(), [](const auto a) { return a == 0; });
    all_awake = dealii::Utilities::MPI::max(asleep, communicator) == 0;
  }

  std::size_t RestRegions::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(moved) + memory_consumption(in_sums) + memory_consumption(in_forces) +
           memory_consumption(neighbours.are_ghosts) + memory_consumption(neighbours.blocks) +
           memory_consumption(slots);
  }

  double RestRegions::share_awake() const
  {
    const double awake = dealii::Utilities::MPI::sum(computed.awake, communicator),
                 all   = dealii::Utilities::MPI::sum(computed.all, communicator);
    return all > 0 ? awake / all : 1.;
  }

  template RestRegions::RestRegions(const Families<2> &, const BondList &, const bool);
  template RestRegions::RestRegions(const Families<3> &, const BondList &, const bool);
} // namespace perideal
