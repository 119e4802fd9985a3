// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_advice_h
#define perideal_application_advice_h

#include <perideal/application/scene_parameters.h>
#include <perideal/application/scene_state.h>

#include <string>
#include <vector>

namespace perideal
{
  /// Which form suits the scene, and why, in one line.
  /// @param thin_cells cells in parts of the body that are one cell thick, where
  ///   the face gradient has no linear fit
  std::string suitable_form(const SceneParameters &parameters, const GlobalIndex thin_cells);

  /// What is likely to spoil the result or to stop the solver, one line each. Collective.
  template <int dim>
  std::vector<std::string> warnings(const SceneParameters &parameters, const SceneState<dim> &scene);
} // namespace perideal

#endif
