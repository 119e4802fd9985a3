// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/cell_steps.h>

#include <utility>

namespace perideal
{
  template <int dim>
  CellSteps::Levels CellSteps::find(const GradientMoments<dim>      &moments,
                                    const Families<dim>             &families,
                                    const BondList                  &bonds,
                                    const std::vector<unsigned int> &own,
                                    const unsigned int               n_levels)
  {
    Levels result;
    result.communicator = families.communicator;
    result.of_nodes     = lowest_of_neighbours(families, bonds, own);
    result.of_nodes.resize(families.n_owned());
    const CellReach<dim> reach(moments, families, bonds);
    result.of_cells = reach.lowest_levels(result.of_nodes);
    for (unsigned int level = 0; level < n_levels; ++level)
      {
        std::vector<LocalIndex> cells;
        for (LocalIndex i = 0; i < result.of_cells.size(); ++i)
          if (result.of_cells[i] == level)
            cells.push_back(i);
        result.subsets.push_back(reach.subset(cells));
        result.pulled.push_back(result.subsets.back().nodes);
      }
    // The lowest of those whose cells they act on.
    result.of_supports.resize(moments.prescribed_values().entries().size());
    for (unsigned int level = n_levels; level-- > 0;)
      for (const std::size_t entry : result.subsets[level].entries)
        result.of_supports[entry] = level;
    return result;
  }

  template <int dim>
  CellSteps::CellSteps(const GradientMoments<dim>      &moments,
                       const Families<dim>             &families,
                       const BondList                  &bonds,
                       const std::vector<unsigned int> &own,
                       const unsigned int               n_levels)
    : CellSteps(find(moments, families, bonds, own, n_levels))
  {
  }

  CellSteps::CellSteps(Levels levels)
    : LocalSteps(levels.of_nodes, levels.of_cells, levels.pulled, levels.of_supports, levels.communicator)
    , subsets(std::move(levels.subsets))
  {
  }

  std::size_t CellSteps::memory_consumption() const
  {
    std::size_t result = LocalSteps::memory_consumption();
    for (const CellSubset &subset : subsets)
      result += subset.memory_consumption();
    return result;
  }

  template CellSteps::CellSteps(const GradientMoments<2> &,
                                const Families<2> &,
                                const BondList &,
                                const std::vector<unsigned int> &,
                                const unsigned int);
  template CellSteps::CellSteps(const GradientMoments<3> &,
                                const Families<3> &,
                                const BondList &,
                                const std::vector<unsigned int> &,
                                const unsigned int);
} // namespace perideal
