// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_free_motions_h
#define perideal_problem_free_motions_h

#include <perideal/operators/system/null_space.h>
#include <perideal/problem/loading.h>

namespace perideal
{
  /**
   * Returns the rigid-body motions that the conditions leave free and the scene removes; empty where they
   * are all held. Needs the parts of the body. Collective.
   * @throws InputError when a body can move as a whole and the scene does not remove that.
   */
  template <int dim>
  NullSpace<dim> find_free_motions(const Loading<dim> &loading, const ConnectedParts<dim> &parts);
} // namespace perideal

#endif
