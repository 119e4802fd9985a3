// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_mesh_error_h
#define perideal_problem_mesh_error_h

#include <perideal/operators/post/error_estimate.h>
#include <perideal/problem/problem.h>

#include <string>

namespace perideal
{
  /// Estimates the error that the mesh leaves in the displacement of the problem's state, the equilibrium of
  /// the linear consistent form under the loads of a time. Collective.
  template <int dim>
  ErrorEstimate estimate_mesh_error(const Problem<dim> &problem, const double time);

  /// The estimate in words.
  std::string in_words(const ErrorEstimate &estimate);

  /// Which mesh would have an error of one per cent, in words: finer where the estimate is above, coarser
  /// where it is below.
  std::string mesh_of_one_percent(const ErrorEstimate &estimate,
                                  const GlobalIndex    n_cells,
                                  const unsigned int   dim,
                                  const unsigned int   refinements);
} // namespace perideal

#endif
