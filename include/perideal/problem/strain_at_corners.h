// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_strain_at_corners_h
#define perideal_problem_strain_at_corners_h

#include <perideal/problem/problem.h>

#include <vector>

namespace perideal
{
  /// Returns p of the strains r^-p around the re-entrant corners of a body, and around those where what is
  /// held ends (BoundaryCorner): of owned nodes within a horizon of one, of others 0. A side that is held
  /// along its normal alone mirrors the body; one held otherwise counts as clamped. Where bonds soften from a
  /// strength on it is 0: those of large cells begin later, but take what a crack takes.
  template <int dim>
  std::vector<double> singular_exponents(const Problem<dim> &problem);

  /// Returns BondForce::utilisation() of a problem with a force, near these corners as it will be in the
  /// smallest cells. These come nearer to the corner, and limits of bonds are those of the smallest cells in
  /// all: so large cells of which bonds are far below their limits are to be halved where bonds of small ones
  /// would have failed.
  /// @param exponents singular_exponents()
  template <int dim>
  std::vector<double> utilisation_in_smallest_cells(const Problem<dim>        &problem,
                                                    const std::vector<double> &exponents);
} // namespace perideal

#endif
