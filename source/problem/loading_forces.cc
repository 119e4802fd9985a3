// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/line_to_point.h>
#include <perideal/boundary/nodal_forces.h>
#include <perideal/materials/bond_based.h>
#include <perideal/operators/post/mirror_reactions.h>
#include <perideal/problem/loading.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  void Loading<dim>::external_force(const DiscreteBody<dim> &discretisation,
                                    const double             time,
                                    NodalVector             &force) const
  {
    set_tractions(discretisation, loads, time, force);
    if (published_transfer)
      published_transfer->add_places(loads, time, force);
    if (extension)
      extension->add_known(loads, time, force);
    point_forces.add(loads, time, force);
  }

  template <int dim>
  void Loading<dim>::set_tractions(const DiscreteBody<dim> &discretisation,
                                   const Loads<dim>        &given,
                                   const double             time,
                                   NodalVector             &force) const
  {
    const SceneParameters &parameters = body.parameters;
    const Nodes<dim>      &nodes      = *body.nodes;
    // No external force acts on nodes that are not those of cells.
    force = 0.;
    if (parameters.model.is_consistent())
      compute_forces_at_faces(nodes, body.faces, *discretisation.gradient, given, time, force);
    else
      compute_nodal_forces(nodes,
                           parameters.loads.act_in_depth() ? std::vector<BoundaryFace<dim>>() : body.faces,
                           given,
                           time,
                           force);
    if (transfer)
      transfer->add_tractions(given, time, force);
    if constexpr (dim == 3)
      if (parameters.loads.has_line_to_point())
        {
          const auto solid_of = solids_of_model(body);
          add_line_to_point_forces(
            nodes,
            surface,
            given,
            time,
            [&](const LocalIndex i) -> LineToPoint {
              const auto   solid   = solid_of(nodes.material[i]).isotropic();
              const double horizon = nodes.horizon[i];
              return {BondBased<dim>::micromodulus(solid.bulk_modulus(), horizon, body.mesh->thickness),
                      horizon,
                      solid.young_modulus,
                      solid.poisson_ratio};
            },
            parameters.loads.traction_treatment == TractionTreatment::published_line_to_point,
            force);
        }
  }

  template <int dim>
  std::vector<typename NullSpace<dim>::Force> Loading<dim>::forces_on_body() const
  {
    const Nodes<dim>                           &nodes = *body.nodes;
    std::vector<typename NullSpace<dim>::Force> result;
    visit_loaded_faces(
      loads, body.faces, [&](const BoundaryCondition<dim> &condition, const BoundaryFace<dim> &face) {
        result.emplace_back(face.centre,
                            face.area * Loads<dim>::traction(condition, face.centre, face.normal, 1.));
      });
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      result.emplace_back(nodes.position[i], nodes.volume[i] * loads.body_force_at(nodes.position[i], 1.));
    if (dealii::Utilities::MPI::this_mpi_process(nodes.communicator) == 0)
      for (const auto &load : loads.point_loads)
        result.emplace_back(load.position, load.force_at(1.));
    return result;
  }

  template <int dim>
  StaticBalance<dim> Loading<dim>::balance(const DiscreteBody<dim>        &discretisation,
                                           const ConstrainedOperator<dim> &system,
                                           const NodalVector              &displacement,
                                           const NodalVector              &external,
                                           const double                    time) const
  {
    if (extension)
      return balance_of_extension(system, displacement, external, time);
    const MPI_Comm communicator = body.nodes->communicator;
    NodalVector    internal_force, free_force;
    system.initialize_all(internal_force);
    system.initialize(free_force);
    system.internal_force(internal_force, displacement);
    std::copy(
      internal_force.begin(), internal_force.begin() + free_force.locally_owned_size(), free_force.begin());

    // Linear: the strain energy is half the work of all forces that act on the body.
    auto from_faces = sum_mirror_reactions(system, loads.conditions.size());
    if (face_values && body.parameters.model.is_consistent() && !holds_nodes())
      {
        const auto forces = discretisation.bonds->support_forces();
        from_faces.force  = face_values->sum_by_condition(forces, communicator);
        from_faces.work   = face_values->work(forces, communicator);
      }
    StaticBalance<dim> result;
    result.strain_energy = 0.5 * (free_force * displacement + from_faces.work);
    free_force -= external;
    const auto at_nodes = held.sum_by_condition(free_force, communicator);
    result.external_work =
      0.5 * (external * displacement + held.work(free_force, displacement, communicator) + from_faces.work);
    result.reactions = holds_nodes() ? at_nodes : from_faces.force;
    return result;
  }

  template <int dim>
  StaticBalance<dim> Loading<dim>::balance_of_extension(const ConstrainedOperator<dim> &system,
                                                        const NodalVector              &displacement,
                                                        const NodalVector              &external,
                                                        const double                    time) const
  {
    StaticBalance<dim> result;
    result.reactions.resize(loads.conditions.size());
    for (const auto &seen : extension->face_tractions(displacement, loads, time))
      for (std::size_t k = 0; k < result.reactions.size(); ++k)
        if (loads.conditions[k].acts_on(seen.boundary))
          for (unsigned int d = 0; d < dim; ++d)
            if (loads.conditions[k].holds(d))
              result.reactions[k][d] += seen.point.area * seen.traction[d];
    for (auto &reaction : result.reactions)
      reaction = dealii::Utilities::MPI::sum(reaction, body.nodes->communicator);

    // What bonds resist with, and what ghosts and other external forces do, which holds the balance.
    NodalVector by_bonds, residual;
    extension->initialize(by_bonds);
    extension->initialize(residual);
    extension->plain_bonds().vmult(by_bonds, displacement);
    system.residual(residual, external, displacement);
    result.strain_energy = 0.5 * (by_bonds * displacement);
    result.external_work = result.strain_energy + 0.5 * (residual * displacement);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Loading)
} // namespace perideal
