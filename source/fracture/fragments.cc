// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/fragments.h>

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
    // Each node takes the smallest number of the nodes connected with it; -1 is damaged.
    NodalVector label(families.make_partitioner(1));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      label.local_element(i) = damage[i] < damaged ? double(families.global_number(i)) : -1.;
    // Horizons are the same multiple of the spacing everywhere.
    const double reach =
      families.n_owned() > 0 ? 1.1 * std::sqrt(double(dim)) * spacing[0] / families.horizon[0] : 0.;
    for (unsigned int changed = 1; changed > 0;)
      {
        label.update_ghost_values();
        changed              = 0;
        bool changed_in_here = true;
        while (changed_in_here)
          {
            changed_in_here = false;
            for (LocalIndex i = 0; i < families.n_owned(); ++i)
              for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
                {
                  const LocalIndex j = bonds.neighbour[slot];
                  double           a = label.local_element(i), b = label.local_element(j);
                  if (a == b || a < 0 || b < 0 ||
                      families.position[i].distance(families.position[j]) >
                        reach * std::max(families.horizon[i], families.horizon[j]))
                    continue;
                  label.local_element(i) = label.local_element(j) = std::min(a, b);
                  if (j < families.n_owned() || b < a)
                    {
                      changed_in_here = true;
                      changed         = 1;
                    }
                }
          }
        label.zero_out_ghost_values();
        changed = dealii::Utilities::MPI::max(changed, families.communicator);
      }

    std::map<double, double> volumes;
    double                   total = 0;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        total += families.volume[i];
        if (label.local_element(i) >= 0)
          volumes[label.local_element(i)] += families.volume[i];
      }
    total = dealii::Utilities::MPI::sum(total, families.communicator);
    std::map<double, double> of_all;
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
