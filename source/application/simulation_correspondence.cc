// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/text.h>
#include <perideal/operators/linear/correspondence_tangent.h>
#include <perideal/parameters/stress_criteria.h>

#include <deal.II/base/mpi.h>

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
    scene.tangent =
      std::make_shared<CorrespondenceTangent<dim>>(scene.families, scene.correspondence, scene.laws);
    scene.bonds = scene.tangent;
  }

  template <int dim>
  void
  Simulation<dim>::set_strengths(const std::function<bool(const LocalIndex, const LocalIndex)> &can_break)
  {
    std::map<dealii::types::material_id, StressCriterion> criteria;
    for (const auto id : scene.mesh->material_ids)
      criteria[id] = stress_criterion(parameters.material, properties_of(id));
    auto &force = dynamic_cast<CorrespondenceForce<dim> &>(*scene.force);
    force.set_strength(
      [criteria](const dealii::types::material_id id, const dealii::SymmetricTensor<2, 3> &stress) {
        return criteria.at(id).utilisation(stress);
      },
      can_break);
  }

  template <int dim>
  void Simulation<dim>::warn_of_lost_thickness()
  {
    const auto *force = dynamic_cast<const CorrespondenceForce<dim> *>(scene.force.get());
    if (force == nullptr || dim == 3)
      return;
    GlobalIndex number = 0;
    LocalIndex  i      = 0;
    for (const auto &H : force->gradients())
      number += force->law(i++).thickness_stretch(H) > 0 ? 0 : 1;
    number                             = dealii::Utilities::MPI::sum(number, communicator);
    summary["nodes_without_thickness"] = number;
    if (number > 0)
      screen << "warning     at " << grouped(number)
             << " nodes the law leaves the body no thickness: it is used beyond its range" << std::endl;
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)

} // namespace perideal
