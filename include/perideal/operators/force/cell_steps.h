// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_cell_steps_h
#define perideal_operators_force_cell_steps_h

#include <perideal/operators/force/local_steps.h>
#include <perideal/operators/weights/cell_reach.h>

#include <vector>

namespace perideal
{
  /// Local steps of the consistent form: its force is split by cells with the bonds of their rows, each of
  /// the lowest level of the nodes that these are made of (CellReach).
  class CellSteps : public LocalSteps
  {
  public:
    /// Collective.
    /// @param own level of each owned node by itself @param n_levels beyond the highest that there may be
    template <int dim>
    CellSteps(const GradientMoments<dim>      &moments,
              const Families<dim>             &families,
              const BondList                  &bonds,
              const std::vector<unsigned int> &own,
              const unsigned int               n_levels);

    const CellSubset &cells(const unsigned int level) const { return subsets[level]; }

    std::size_t memory_consumption() const override;

  private:
    /// What is found before there are any steps.
    struct Levels
    {
      std::vector<unsigned int>            of_nodes, of_cells, of_supports;
      std::vector<CellSubset>              subsets;
      std::vector<std::vector<LocalIndex>> pulled;
      MPI_Comm                             communicator;
    };
    explicit CellSteps(Levels levels);
    template <int dim>
    static Levels find(const GradientMoments<dim>      &moments,
                       const Families<dim>             &families,
                       const BondList                  &bonds,
                       const std::vector<unsigned int> &own,
                       const unsigned int               n_levels);

    /// By level.
    std::vector<CellSubset> subsets;
  };
} // namespace perideal

#endif
