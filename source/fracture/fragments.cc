// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/fragments.h>
#include <perideal/neighbourhood/components.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace perideal
{
  template <int dim>
  std::vector<double> find_fragments(const Families<dim>       &families,
                                     const BondList            &bonds,
                                     const std::vector<double> &spacing,
                                     const std::vector<double> &damage,
                                     const double               damaged)
  {
    NodalVector of_all_nodes(families.make_partitioner(1));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      of_all_nodes.local_element(i) = damage[i];
    of_all_nodes.update_ghost_values();
    const auto is_whole = [&](const LocalIndex i) { return of_all_nodes.local_element(i) < damaged; };
    // Horizons are the same multiple of the spacing everywhere.
    const double reach =
      families.n_owned() > 0 ? 1.1 * std::sqrt(double(dim)) * spacing[0] / families.horizon[0] : 0.;
    const auto component =
      find_components<dim>(families, bonds, [&](const LocalIndex i, const LocalIndex j, const BondIndex) {
        return is_whole(i) && is_whole(j) &&
               families.position[i].distance(families.position[j]) <=
                 reach * std::max(families.horizon[i], families.horizon[j]);
      });

    std::map<GlobalIndex, double> volumes, of_all;
    double                        total = 0;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        total += families.volume[i];
        if (is_whole(i))
          volumes[component[i]] += families.volume[i];
      }
    total = dealii::Utilities::MPI::sum(total, families.communicator);
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(families.communicator, volumes))
      for (const auto &piece : of_rank)
        of_all[piece.first] += piece.second;
    std::vector<double> result;
    for (const auto &piece : of_all)
      if (piece.second >= 0.005 * total)
        result.push_back(piece.second);
    std::sort(result.begin(), result.end(), std::greater<double>());
    return result;
  }

  PERIDEAL_INSTANTIATE(find_fragments)
} // namespace perideal
