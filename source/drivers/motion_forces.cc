// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/drivers/motion_forces.h>

#include <algorithm>
#include <vector>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  template <int dim>
  void MotionForces<dim>::make_damping(const Problem<dim> &problem)
  {
    const double rate = problem.parameters.solver.relative_damping;
    if (rate > 0)
      damping = std::make_unique<RelativeDamping<dim>>(
        problem.discretisation.weights, rate, [&](const dealii::types::material_id id) {
          return problem.body.density_of(id);
        });
  }

  template <int dim>
  void MotionForces<dim>::make_contact(const Problem<dim> &problem)
  {
    if (!has_contact(problem.parameters))
      return;
    std::vector<bool> on_surface(problem.body.nodes->size(), false);
    for (const BoundaryFace<dim> &face : problem.body.faces)
      on_surface[face.node] = true;
    contact = std::make_unique<ContactForce<dim>>(
      problem.discretisation.families,
      problem.parameters.contact,
      problem.parameters.nodes.horizon_factor,
      [&](const dealii::types::material_id id) {
        return problem.body.solids.at(id).isotropic().bulk_modulus();
      },
      on_surface);
  }

  template <int dim>
  void MotionForces<dim>::act_on(ExplicitDynamics<dim> &dynamics) const
  {
    if (contact)
      dynamics.set_contact(contact.get());
    if (damping)
      dynamics.set_relative_damping(damping.get());
  }

  template <int dim>
  void MotionForces<dim>::record(Json &summary) const
  {
    if (!contact)
      return;
    const double before = summary.contains("contact") ? summary["contact"].value("largest_overlap", 0.) : 0.;
    summary["contact"]  = {{"pairs", contact->n_contacts()},
                           {"largest_overlap", std::max(before, contact->largest_overlap())},
                           {"searches", contact->n_searches()}};
  }

  template <int dim>
  std::string MotionForces<dim>::describe(const Json &summary)
  {
    if (!summary.contains("contact") || !(summary["contact"].at("largest_overlap").get<double>() > 0.5))
      return {};
    return "warning     nodes came to less than half their contact distance and may have passed each other: "
           "raise Contact/Stiffness\n";
  }

  PERIDEAL_INSTANTIATE_CLASS(MotionForces)
} // namespace perideal
