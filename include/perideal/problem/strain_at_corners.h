// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_strain_at_corners_h
#define perideal_problem_strain_at_corners_h

#include <perideal/problem/problem.h>

#include <vector>

namespace perideal
{
  /// Returns BondForce::utilisation() of a problem with a force, within a horizon of re-entrant corners as it
  /// will be in the smallest cells. The strain goes with r^-p (singular_exponent()), the smallest cells come
  /// nearer to the corner, and limits of bonds are those of the smallest cells in all: so large cells of
  /// which bonds are far below their limits are to be halved where bonds of small ones would have failed.
  template <int dim>
  std::vector<double> utilisation_in_smallest_cells(const Problem<dim> &problem);
} // namespace perideal

#endif
