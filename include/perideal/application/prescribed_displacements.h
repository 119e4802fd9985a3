// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_prescribed_displacements_h
#define perideal_application_prescribed_displacements_h

#include <perideal/application/scene_state.h>
#include <perideal/output/history.h>

#include <nlohmann/json.hpp>

namespace perideal
{
  /**
   * Adds to the row of the history how far each condition has moved what it holds, "displacement of NAME
   * along x [m]", for curves of reactions: the mean over its faces of the displacement that it prescribes, or
   * over the nodes that it holds of what its velocity has come to. Collective.
   * @return for summary.json, by condition; null for components that it leaves free
   */
  template <int dim>
  nlohmann::ordered_json
  record_displacements(const SceneState<dim> &scene, const double time, History &history);
} // namespace perideal

#endif
