// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/report.h>
#include <perideal/application/simulation.h>
#include <perideal/base/instantiate.h>
#include <perideal/operators/system/stable_time_step.h>

#include <cmath>

// Simulation: contact and relative damping of dynamics, and the step that is stable with damping.

namespace perideal
{
  template <int dim>
  void Simulation<dim>::make_relative_damping()
  {
    if (parameters.solver.relative_damping > 0)
      scene.relative_damping = std::make_unique<RelativeDamping<dim>>(
        scene.weights, parameters.solver.relative_damping, [&](const dealii::types::material_id id) {
          return properties_of(id).density;
        });
  }

  template <int dim>
  void Simulation<dim>::make_contact()
  {
    if (!has_contact(parameters))
      return;
    std::vector<bool> on_surface(scene.nodes->size(), false);
    for (const BoundaryFace<dim> &face : scene.faces)
      on_surface[face.node] = true;
    scene.contact = std::make_unique<ContactForce<dim>>(
      scene.families,
      parameters.contact,
      parameters.nodes.horizon_factor,
      [&](const dealii::types::material_id id) { return scene.solids.at(id).isotropic().bulk_modulus(); },
      on_surface);
  }

  template <int dim>
  double Simulation<dim>::largest_stable_step() const
  {
    const double undamped = stable_time_step(
      *scene.system, [&](const dealii::types::material_id id) { return properties_of(id).density; });
    const double relative = scene.relative_damping ? scene.relative_damping->largest_rate() : 0.;
    return damped_time_step(undamped, parameters.solver.damping + relative);
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
