// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_boundary_stress_h
#define perideal_application_boundary_stress_h

#include <perideal/application/scene_parameters.h>
#include <perideal/application/scene_state.h>

#include <nlohmann/json.hpp>

namespace perideal
{
  /**
   * Stresses at the faces of the boundaries of Output/Boundary stress: writes
   * stress_NAME.csv into the output directory, and returns the part "boundary_stress"
   * of summary.json on rank 0 (on others without figures): by boundary the largest
   * principal stress with its place, the smallest, the largest von Mises stress, and with a
   * nominal stress the concentration. Collective.
   */
  template <int dim>
  nlohmann::ordered_json
  write_boundary_stress(const SceneState<dim> &scene, const SceneParameters &parameters, const double time);

  /// A line for the screen from each boundary's part of it.
  std::string describe_boundary_stress(const nlohmann::ordered_json &boundary_stress);
} // namespace perideal

#endif
