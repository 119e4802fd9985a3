// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_make_gauges_h
#define perideal_problem_make_gauges_h

#include <perideal/boundary/gauges.h>
#include <perideal/problem/problem.h>

namespace perideal
{
  /// Makes the gauges of a scene, to be read off the displacement of its unknowns. Collective.
  /// @throws InputError on a gauge that is none, or ends outside the body.
  template <int dim>
  Gauges<dim> make_gauges(const Problem<dim> &problem);
} // namespace perideal

#endif
