// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_cell_reach_h
#define perideal_operators_weights_cell_reach_h

#include <perideal/neighbourhood/bond_list.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/operators/weights/cell_subset.h>
#include <perideal/operators/weights/gradient_moments.h>

#include <vector>

namespace perideal
{
  /**
   * Knows of which nodes the cells of the consistent form are made: a cell and the bonds of its row of the
   * gradients of the cell and of those at the far ends of these bonds (ConsistentBonds); a gradient of the
   * polynomials on both sides of the cell's faces; a polynomial of its stencil (GradientMoments).
   */
  template <int dim>
  class CellReach
  {
  public:
    /// The arguments must outlive this object.
    CellReach(const GradientMoments<dim> &moments, const Families<dim> &families, const BondList &bonds)
      : moments(moments)
      , families(families)
      , bonds(bonds)
    {
    }

    /// The lowest of the levels of the nodes that owned cells are made of. Collective.
    /// @param of_nodes by owned node
    std::vector<unsigned int> lowest_levels(const std::vector<unsigned int> &of_nodes) const;

    /// What is to be evaluated for some owned cells. Collective.
    /// @param own in ascending order
    CellSubset subset(const std::vector<LocalIndex> &own) const;

  private:
    using FaceCells = std::vector<LocalIndex>;
    /// The local nodes of the cells of a face.
    FaceCells cells_of(const std::size_t face) const;

    const GradientMoments<dim> &moments;
    const Families<dim>        &families;
    const BondList             &bonds;
  };
} // namespace perideal

#endif
