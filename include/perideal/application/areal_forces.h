// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_areal_forces_h
#define perideal_application_areal_forces_h

#include <perideal/application/scene_parameters.h>
#include <perideal/application/scene_state.h>
#include <perideal/output/history.h>

#include <nlohmann/json.hpp>

#include <memory>
#include <string>

namespace perideal
{
  /// The areal force densities that the scene asks for; null where it asks for none. Needs nodes, faces and
  /// the model. Collective.
  /// @param solid_of by material id, as the model takes it
  /// @throws InputError on points outside the body, and where a rule cannot be.
  template <int dim>
  std::unique_ptr<ArealForceDensity<dim>> create_areal_forces(const SceneState<dim> &scene,
                                                              const SceneParameters &parameters,
                                                              const SolidOf<dim>    &solid_of);

  /// Evaluates those of the scene for the stored displacement and the last bond forces, adds columns to the
  /// row of the history, and returns the part "areal_force_densities" of summary.json: by name "traction"
  /// [Pa] and "rule". Collective.
  template <int dim>
  nlohmann::ordered_json
  record_areal_forces(const SceneState<dim> &scene, const SceneParameters &parameters, History &history);

  /// A line for the screen from each of them.
  std::string describe_areal_forces(const nlohmann::ordered_json &areal_forces);
} // namespace perideal

#endif
