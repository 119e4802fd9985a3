// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/local_steps.h>
#include <perideal/operators/force/rest_regions.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// Calls visit(i, j) with the ends of all bonds of this rank.
    template <typename Visit>
    void visit_ends(const BondList &bonds, const Visit &visit)
    {
      for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
        for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
          visit(i, bonds.neighbour[slot]);
    }
  } // namespace

  template <int dim>
  std::vector<unsigned int> lowest_of_neighbours(const Families<dim>             &families,
                                                 const BondList                  &bonds,
                                                 const std::vector<unsigned int> &levels)
  {
    NodalVector of_nodes(families.make_partitioner(1)), result(of_nodes);
    std::copy_n(levels.begin(), families.n_owned(), of_nodes.begin());
    of_nodes.update_ghost_values();
    std::copy_n(levels.begin(), families.n_owned(), result.begin());
    visit_ends(bonds, [&](const LocalIndex i, const LocalIndex j) {
      result.local_element(i) = std::min(result.local_element(i), of_nodes.local_element(j));
      // A bond that the partition cuts stands on both ranks.
      if (j < families.n_owned())
        result.local_element(j) = std::min(result.local_element(j), of_nodes.local_element(i));
    });
    result.update_ghost_values();
    std::vector<unsigned int> lowest(families.n_local());
    for (LocalIndex i = 0; i < lowest.size(); ++i)
      lowest[i] = static_cast<unsigned int>(result.local_element(i));
    return lowest;
  }

  template <int dim>
  LocalSteps::LocalSteps(const Families<dim>             &families,
                         const BondList                  &bonds,
                         const std::vector<unsigned int> &own,
                         const unsigned int               n_levels)
    : nodes(lowest_of_neighbours(families, bonds, own))
    , blocks((families.n_owned() + RestRegions::block_size - 1) / RestRegions::block_size, n_levels - 1)
  {
    const std::vector<unsigned int> of_families = lowest_of_neighbours(families, bonds, nodes);
    const LocalIndex                n_owned     = families.n_owned();
    nodes.resize(n_owned);
    const auto add = [&](const LocalIndex row, const LocalIndex family) {
      unsigned int &level = blocks[row / RestRegions::block_size];
      level               = std::min(level, of_families[family]);
    };
    for (LocalIndex i = 0; i < n_owned; ++i)
      add(i, i);
    visit_ends(bonds, add);

    std::vector<std::vector<LocalIndex>> pulled(n_levels);
    for (unsigned int level = 0; level < n_levels; ++level)
      {
        std::vector<bool> is_pulled(families.n_local(), false);
        visit_ends(bonds, [&](const LocalIndex i, const LocalIndex j) {
          if (blocks[i / RestRegions::block_size] == level)
            is_pulled[i] = is_pulled[j] = true;
        });
        for (LocalIndex i = 0; i < n_owned; ++i)
          if (is_pulled[i])
            pulled[level].push_back(i);
      }
    make_lists(of_families, pulled, families.communicator);
  }

  LocalSteps::LocalSteps(const std::vector<unsigned int>            &nodes,
                         const std::vector<unsigned int>            &of_cells,
                         const std::vector<std::vector<LocalIndex>> &pulled,
                         const std::vector<unsigned int>            &supports,
                         MPI_Comm                                    communicator)
    : nodes(nodes)
    , supports(supports)
  {
    make_lists(of_cells, pulled, communicator);
  }

  void LocalSteps::make_lists(const std::vector<unsigned int>            &of_families,
                              const std::vector<std::vector<LocalIndex>> &pulled,
                              MPI_Comm                                    communicator)
  {
    const LocalIndex   n_owned  = nodes.size();
    const unsigned int n_levels = pulled.size();
    forces.assign(n_owned, n_levels - 1);
    for (unsigned int level = n_levels; level-- > 0;)
      for (const LocalIndex i : pulled[level])
        forces[i] = level;
    lists.resize(n_levels);
    counts.assign(n_levels, 0);
    for (LocalIndex i = 0; i < n_owned; ++i)
      ++counts[of_families[i]];
    for (unsigned int level = 0; level < n_levels; ++level)
      {
        lists[level].pulled_alone = pulled[level];
        for (LocalIndex i = 0; i < n_owned; ++i)
          {
            if (nodes[i] <= level)
              lists[level].moving.push_back(i);
            if (of_families[i] <= level)
              lists[level].families.push_back(i);
            if (forces[i] <= level)
              lists[level].pulled.push_back(i);
          }
      }
    dealii::Utilities::MPI::sum(counts, communicator, counts);
    lowest =
      std::find_if(counts.begin(), counts.end(), [](const GlobalIndex n) { return n > 0; }) - counts.begin();
  }

  bool LocalSteps::any_up_to(const unsigned int level) const
  {
    return lowest <= level;
  }

  double LocalSteps::share_of_cell_steps() const
  {
    double evaluated = 0, all = 0;
    for (unsigned int level = 0; level < n_levels(); ++level)
      {
        evaluated += static_cast<double>(counts[level]) / (1u << level);
        all += counts[level];
      }
    return evaluated / all;
  }

  std::size_t LocalSteps::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    std::size_t result = 0;
    for (const Lists &of_level : lists)
      result += memory_consumption(of_level.moving) + memory_consumption(of_level.families) +
                memory_consumption(of_level.pulled) + memory_consumption(of_level.pulled_alone);
    return result + memory_consumption(nodes) + memory_consumption(forces) + memory_consumption(blocks);
  }

  template LocalSteps::LocalSteps(const Families<2> &,
                                  const BondList &,
                                  const std::vector<unsigned int> &,
                                  const unsigned int);
  template LocalSteps::LocalSteps(const Families<3> &,
                                  const BondList &,
                                  const std::vector<unsigned int> &,
                                  const unsigned int);
  template std::vector<unsigned int>
  lowest_of_neighbours(const Families<2> &, const BondList &, const std::vector<unsigned int> &);
  template std::vector<unsigned int>
  lowest_of_neighbours(const Families<3> &, const BondList &, const std::vector<unsigned int> &);
} // namespace perideal
