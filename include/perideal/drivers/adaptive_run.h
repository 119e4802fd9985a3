// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_drivers_adaptive_run_h
#define perideal_drivers_adaptive_run_h

#include <perideal/problem/run.h>
#include <perideal/problem/scene_parameters.h>

namespace perideal
{
  /**
   * Runs a scene on meshes that adapt.
   *
   * By error, in linear statics, the mesh is refined where it takes it: solves to a hundredth of
   * the wanted error, estimates the error, refines the cells that carry most of it, and begins anew, until
   * the estimate is what is wanted. The last mesh is solved on as any other. Where the cycles or the cells
   * that are allowed end before, the run goes on with what is reached, and a warning says so.
   *
   * By need, along load steps or a motion, cells are halved where MeshNeed says so, before the first step and
   * between steps; what lasts is carried by CarriedState, the problem is built anew on the changed mesh and
   * goes on as from a checkpoint. Collective.
   * @throws InputError, ComputationError and Stopped as Driver::run() does.
   */
  template <int dim>
  void run_adaptively(const SceneParameters &parameters, const RunContext &context, MPI_Comm communicator);
} // namespace perideal

#endif
