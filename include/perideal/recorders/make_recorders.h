// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_recorders_make_recorders_h
#define perideal_recorders_make_recorders_h

#include <perideal/problem/problem.h>
#include <perideal/recorders/recorder.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// What a kind of run has that recorders can record.
  struct RunKind
  {
    /// Bonds that move in time, with velocities.
    bool has_motion = false;
    /// Searches for equilibria of a force that is not linear.
    bool has_iterations = false;
    /// With linear solves in each of them.
    bool has_linear_iterations = false;
  };

  /// Returns what the scene asks to be recorded, in the order of the history's columns. Collective.
  /// @throws InputError on cracks, gauges or points that cannot be.
  template <int dim>
  std::vector<std::unique_ptr<Recorder<dim>>> make_recorders(Problem<dim> &problem, const RunKind &kind);
} // namespace perideal

#endif
