// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_local_refinement_h
#define perideal_mesh_local_refinement_h

#include <deal.II/grid/tria.h>

#include <set>
#include <string>

namespace perideal
{
  /// Refinement towards boundaries and at places.
  struct LocalRefinement
  {
    std::set<dealii::types::boundary_id> boundaries;
    /// How often.
    unsigned int times = 0;
    /// How many cells deep: 1 are those that touch a boundary, be it with one vertex only.
    unsigned int layers = 1;
    /// Formula in x, y, z that is not zero where cells are refined as often; empty: nowhere.
    std::string where = {};
  };

  /**
   * Refines, again and again, the cells in some layers along the boundaries, on which no
   * hanging vertex lies then, and those with their centre or a vertex at the places. Collective on
   * distributed triangulations.
   * @throws InputError on a wrong formula, and when the cells become too many to be numbered.
   */
  template <int dim>
  void refine_locally(const LocalRefinement &refinement, dealii::Triangulation<dim> &triangulation);
} // namespace perideal

#endif
