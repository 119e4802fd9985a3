// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/operators/correspondence_tangent.h>

// Simulation: the correspondence model.

namespace perideal
{
  template <int dim>
  void Simulation<dim>::make_correspondence()
  {
    const Timings::Scope part(timings, "setup: weights");
    for (const auto &solid : scene.solids)
      scene.laws[solid.first] = create_law<dim>(parameters.model.law, solid.second);
    const bool by_faces  = parameters.model.is_consistent();
    scene.correspondence = std::make_shared<CorrespondenceRows<dim>>(
      scene.families,
      by_faces ? scene.gradient : nullptr,
      by_faces ? scene.face_values : nullptr,
      create_correspondence<dim>(parameters.model),
      [this](const dealii::types::material_id id) { return scene.solids.at(id); });
    scene.tangent = std::make_shared<CorrespondenceTangent<dim>>(scene.families, scene.correspondence, scene.laws);
    scene.bonds   = scene.tangent;
  }

  template void Simulation<2>::make_correspondence();
  template void Simulation<3>::make_correspondence();
} // namespace perideal
