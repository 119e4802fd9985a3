// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_local_refinement_h
#define perideal_mesh_local_refinement_h

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

namespace perideal
{
  /**
   * Returns how many cells of each size must lie between larger and smaller ones, so that no family meets
   * three sizes: n of h/2 and a half of the first of h/4, from the middle of a cell h, are longer than its
   * horizon m h if n > 2 m - 5/4. With a layer less, auxiliary preconditioners take four times the
   * iterations (square grids, m = 3.01, two to four sizes); four serve the smallest horizons.
   * @param horizon_factor m
   */
  inline unsigned int layers_between_sizes(const double horizon_factor)
  {
    return std::max(4u, static_cast<unsigned int>(std::ceil(2. * horizon_factor - 1.25)));
  }

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
