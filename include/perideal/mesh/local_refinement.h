// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_local_refinement_h
#define perideal_mesh_local_refinement_h

#include <deal.II/grid/tria.h>

#include <set>

namespace perideal
{
  /// Refinement towards boundaries.
  struct LocalRefinement
  {
    std::set<dealii::types::boundary_id> boundaries;
    /// How often.
    unsigned int times = 0;
    /// How many cells deep: 1 are those that touch a boundary, be it with one vertex only.
    unsigned int layers = 1;
  };

  /**
   * Refines, again and again, the cells in some layers along the boundaries. No
   * hanging vertex lies on these. Collective on distributed triangulations.
   * @throws InputError when the cells become too many to be numbered.
   */
  template <int dim>
  void refine_locally(const LocalRefinement &refinement, dealii::Triangulation<dim> &triangulation);
} // namespace perideal

#endif
