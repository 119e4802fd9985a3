// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/balanced_transfer.h>
#include <perideal/boundary/line_to_point.h>
#include <perideal/boundary/nodal_forces.h>
#include <perideal/materials/bond_based.h>
#include <perideal/operators/linear/nodal_springs.h>

#include <deal.II/base/mpi.h>

// Simulation: loads and prescribed displacements.

namespace perideal
{
  template <int dim>
  void Simulation<dim>::make_transfer()
  {
    const Timings::Scope   part(timings, "setup: transfer functions");
    TransferFunctions<dim> functions(*scene.nodes, scene.surface);
    if (!parameters.loads.has_published_transfer())
      {
        scene.transfer = std::make_shared<BalancedTransfer<dim>>(std::move(functions));
        return;
      }
    scene.published_transfer = std::make_shared<PublishedTransfer<dim>>(
      std::move(functions), scene.loads, parameters.loads.transfer_chi, parameters.loads.transfer_lambda);
    scene.transfer = scene.published_transfer;
    if (!scene.published_transfer->springs().empty())
      scene.bonds = std::make_shared<NodalSprings<dim>>(scene.bonds, scene.published_transfer->springs());
  }

  template <int dim>
  void Simulation<dim>::apply_forces(const double time)
  {
    set_tractions(scene.loads, time, external_force);
    if (scene.published_transfer)
      scene.published_transfer->add_places(scene.loads, time, external_force);
    if (scene.ghosts)
      scene.ghosts->add_known(scene.loads, time, external_force);
    scene.point_forces.add(scene.loads, time, external_force);
  }

  template <int dim>
  void Simulation<dim>::set_tractions(const Loads<dim> &given, const double time, NodalVector &force) const
  {
    const LoadParameters &loads = parameters.loads;
    // No external force acts on nodes that are not those of cells.
    force = 0.;
    if (parameters.model.is_consistent())
      compute_forces_at_faces(*scene.nodes, scene.faces, *scene.gradient, given, time, force);
    else
      compute_nodal_forces(*scene.nodes,
                           loads.act_in_depth() ? std::vector<BoundaryFace<dim>>() : scene.faces,
                           given,
                           time,
                           force);
    if (scene.transfer)
      scene.transfer->add_tractions(given, time, force);
    if constexpr (dim == 3)
      if (loads.has_line_to_point())
        {
          const auto solid_of = solid_of_model();
          add_line_to_point_forces(
            *scene.nodes,
            scene.surface,
            given,
            time,
            [&](const LocalIndex i) -> LineToPoint {
              const auto   solid   = solid_of(scene.nodes->material[i]).isotropic();
              const double horizon = scene.nodes->horizon[i];
              return {BondBased<dim>::micromodulus(solid.bulk_modulus(), horizon, scene.mesh->thickness),
                      horizon,
                      solid.young_modulus,
                      solid.poisson_ratio};
            },
            loads.traction_treatment == TractionTreatment::published_line_to_point,
            force);
        }
  }

  template <int dim>
  void Simulation<dim>::apply_loads(const double time)
  {
    scene.mirror->set_time(scene.loads, time);
    // Along nonlinear equilibria, values at faces move with the solver.
    if (scene.face_values && !parameters.solver.is_nonlinear_static())
      scene.face_values->set_time(scene.loads, time);
    apply_forces(time);
    if (parameters.loads.displacement_treatment == DisplacementTreatment::reference)
      {
        // The reference belongs to the final loads; linear scenes scale.
        NodalField<dim> values = scene.comparisons.at("reference");
        for (auto &value : values)
          value *= time;
        scene.held.set_nodal_values(values, displacement);
      }
    else
      scene.held.set_boundary_values(scene.loads, time, displacement);
  }

  template <int dim>
  std::vector<typename NullSpace<dim>::Force> Simulation<dim>::forces_on_body() const
  {
    std::vector<typename NullSpace<dim>::Force> result;
    visit_loaded_faces(
      scene.loads, scene.faces, [&](const BoundaryCondition<dim> &condition, const BoundaryFace<dim> &face) {
        result.emplace_back(face.centre,
                            face.area * Loads<dim>::traction(condition, face.centre, face.normal, 1.));
      });
    for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
      result.emplace_back(scene.nodes->position[i],
                          scene.nodes->volume[i] * scene.loads.body_force_at(scene.nodes->position[i], 1.));
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      for (const auto &load : scene.loads.point_loads)
        result.emplace_back(load.position, load.force_at(1.));
    return result;
  }

  template <int dim>
  void Simulation<dim>::check_loads()
  {
    scene.system->initialize(displacement);
    scene.system->initialize(external_force);
    check_finite(scene.faces, scene.loads, 1., communicator);
    scene.held.check_finite(scene.loads, 1., communicator);
    apply_loads(1.);
    NodalVector residual;
    scene.system->initialize(residual);
    scene.system->residual(residual, external_force, displacement);
    // What bonds, ghosts and the published transfer make of tractions balances roughly; the tractions must.
    const double share =
      parameters.loads.act_in_depth() && parameters.loads.traction_treatment != TractionTreatment::transfer ?
        scene.null_space.share_in(forces_on_body(), communicator) :
        scene.null_space.share_in(residual);
    if (share > 1e-6)
      throw InputError("the loads push the body along a rigid-body motion that nothing holds")
        .parameter("Boundary conditions/Rigid body motions")
        .hint("balance the loads, or hold the body");
    displacement = 0.;
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)
} // namespace perideal
