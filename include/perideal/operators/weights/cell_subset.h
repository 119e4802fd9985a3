// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_cell_subset_h
#define perideal_operators_weights_cell_subset_h

#include <perideal/base/types.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace perideal
{
  /**
   * Lists what the consistent form has to evaluate for the energy of some cells and of the bonds of their
   * rows (GradientMoments, ConsistentBonds), of owned cells and nodes, each in ascending order. What other
   * ranks need for theirs is listed too.
   */
  struct CellSubset
  {
    /// The cells; others at the far ends of their bonds, whose gradients these ask for.
    std::vector<LocalIndex> own, far_ends;
    /// Faces of all these, cells that have polynomials there, and which of these have no gradient.
    std::vector<std::size_t> faces;
    std::vector<LocalIndex>  polynomials, without_gradient;
    /// Nodes that these polynomials are made of.
    std::vector<LocalIndex> nodes;
    /// Prescribed values at faces of cells that have gradients.
    std::vector<std::size_t> entries;

    std::size_t memory_consumption() const
    {
      using dealii::MemoryConsumption::memory_consumption;
      return memory_consumption(own) + memory_consumption(far_ends) + memory_consumption(faces) +
             memory_consumption(polynomials) + memory_consumption(without_gradient) +
             memory_consumption(nodes) + memory_consumption(entries);
    }
  };

  /// Calls visit(i) for the cells of a subset that have gradients; without one, for all owned ones.
  template <typename Visit>
  void visit_gradients(const CellSubset *some, const LocalIndex n_owned, const Visit &visit)
  {
    if (!some)
      for (LocalIndex i = 0; i < n_owned; ++i)
        visit(i);
    else
      for (const auto *cells : {&some->own, &some->far_ends})
        std::for_each(cells->begin(), cells->end(), visit);
  }

  /// Numbers of a loop: those listed, or all up to a number.
  template <typename Index>
  class LoopOver
  {
  public:
    /// @param some null: all
    LoopOver(const std::vector<Index> *some, const std::size_t n_all)
      : listed(some != nullptr ? some->data() : nullptr)
      , n(some != nullptr ? some->size() : n_all)
    {
    }

    std::size_t size() const { return n; }
    Index       operator[](const std::size_t k) const
    {
      return listed != nullptr ? listed[k] : static_cast<Index>(k);
    }

  private:
    const Index      *listed;
    const std::size_t n;
  };
} // namespace perideal

#endif
