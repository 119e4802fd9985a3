// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/neighbourhood/components.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    using Pair = std::pair<GlobalIndex, GlobalIndex>;

    /// Of each number in the pairs of all ranks, the smallest one that a chain of pairs leads to.
    std::map<GlobalIndex, GlobalIndex> join_numbers(std::vector<Pair> pairs, MPI_Comm communicator)
    {
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
      const auto                          of_all = dealii::Utilities::MPI::all_gather(communicator, pairs);
      std::map<GlobalIndex, unsigned int> place;
      for (const auto &of_rank : of_all)
        for (const auto &[a, b] : of_rank)
          place[a] = place[b] = 0;
      unsigned int n = 0;
      for (auto &entry : place)
        entry.second = n++;
      Components components(n);
      for (const auto &of_rank : of_all)
        for (const auto &[a, b] : of_rank)
          components.join(place[a], place[b]);
      // Numbers ascend, so that the first one of a component is its smallest.
      const auto                         numbered = components.number();
      std::vector<GlobalIndex>           smallest;
      std::map<GlobalIndex, GlobalIndex> result;
      for (const auto &[number, k] : place)
        {
          if (numbered.first[k] == smallest.size())
            smallest.push_back(number);
          result[number] = smallest[numbered.first[k]];
        }
      return result;
    }
  } // namespace

  void Components::join_all(const std::set<std::pair<unsigned int, unsigned int>> &links,
                            MPI_Comm                                               communicator)
  {
    const std::vector<std::pair<unsigned int, unsigned int>> mine(links.begin(), links.end());
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(communicator, mine))
      for (const auto &[a, b] : of_rank)
        join(a, b);
  }

  std::pair<std::vector<unsigned int>, unsigned int> Components::number()
  {
    std::map<unsigned int, unsigned int> of_leader;
    std::vector<unsigned int>            result(n_things);
    for (unsigned int k = 0; k < n_things; ++k)
      result[k] =
        of_leader.insert({sets.find_set(k), static_cast<unsigned int>(of_leader.size())}).first->second;
    return {result, static_cast<unsigned int>(of_leader.size())};
  }

  template <int dim>
  std::vector<GlobalIndex>
  find_components(const Families<dim> &families,
                  const BondList      &bonds,
                  const std::function<bool(const LocalIndex, const LocalIndex, const BondIndex slot)> &links)
  {
    // First among the nodes of this rank.
    const LocalIndex  n_owned = families.n_owned();
    Components        local(families.n_local());
    std::vector<bool> is_linked(families.n_local(), false);
    for (LocalIndex i = 0; i < n_owned; ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot]; j != i && links(i, j, slot))
          {
            local.join(i, j);
            is_linked[j] = true;
          }
    const auto               component = local.number();
    std::vector<GlobalIndex> smallest(component.second);
    for (LocalIndex i = n_owned; i-- > 0;)
      smallest[component.first[i]] = families.global_number(i);
    std::vector<GlobalIndex> result(n_owned);
    NodalVector              label(families.make_partitioner(1));
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        result[i]              = smallest[component.first[i]];
        label.local_element(i) = static_cast<double>(result[i]);
      }

    // Then across ranks: a ghost is in a component of this rank and in one of its owner.
    label.update_ghost_values();
    std::vector<Pair> across;
    for (LocalIndex g = n_owned; g < families.n_local(); ++g)
      if (is_linked[g])
        across.emplace_back(smallest[component.first[g]], static_cast<GlobalIndex>(label.local_element(g)));
    const auto joined = join_numbers(across, families.communicator);
    for (GlobalIndex &number : result)
      if (const auto found = joined.find(number); found != joined.end())
        number = found->second;
    return result;
  }

  PERIDEAL_INSTANTIATE(find_components)
} // namespace perideal
