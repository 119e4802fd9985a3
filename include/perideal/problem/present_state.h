// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_present_state_h
#define perideal_problem_present_state_h

#include <perideal/problem/problem.h>

namespace perideal
{
  /// Returns the nodes whose values a problem's state holds: owned ones and ghosts, by their keys.
  /// Collective.
  template <int dim>
  CheckpointNodes nodes_of_state(const Problem<dim> &problem);

  /// Returns all that lasts of a problem after a step. Collective.
  template <int dim>
  Checkpoint state_after(const Problem<dim> &problem, const std::uint64_t step, const double time);
} // namespace perideal

#endif
