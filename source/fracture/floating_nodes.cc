// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/floating_nodes.h>
#include <perideal/neighbourhood/components.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>

namespace perideal
{
  namespace
  {
    /// The owned nodes with that many held components at least.
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
    const LocalIndex        n_owned      = families.n_owned();
    std::vector<LocalIndex> supports     = held_nodes<dim>(n_owned, held, dim);
    const auto              exist_on_any = [&] {
      return dealii::Utilities::MPI::max(supports.empty() ? 0 : 1, families.communicator) == 1;
    };
    if (!exist_on_any())
      supports = held_nodes<dim>(n_owned, held, 1);
    std::vector<bool> floats(n_owned, false);
    if (!exist_on_any())
      return floats;

    const auto component =
      find_components<dim>(families, bonds, [&](const LocalIndex, const LocalIndex, const BondIndex slot) {
        return !is_lost(slot);
      });
    std::set<GlobalIndex> mine, supported;
    for (const LocalIndex i : supports)
      mine.insert(component[i]);
    const std::vector<GlobalIndex> sent(mine.begin(), mine.end());
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(families.communicator, sent))
      supported.insert(of_rank.begin(), of_rank.end());
    for (LocalIndex i = 0; i < n_owned; ++i)
      floats[i] = supported.count(component[i]) == 0;
    return floats;
  }

  PERIDEAL_INSTANTIATE(find_floating_nodes)
} // namespace perideal
