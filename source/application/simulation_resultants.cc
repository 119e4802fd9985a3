// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/simulation.h>
#include <perideal/base/instantiate.h>
#include <perideal/boundary/face_tractions.h>

#include <deal.II/base/mpi.h>

// Simulation: what the loads add up to, and what the nodes get of them.

namespace perideal
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    /// Sum over ranks.
    template <int dim>
    Resultant<dim> sum_of(const Resultant<dim> &part, MPI_Comm communicator)
    {
      return {dealii::Utilities::MPI::sum(part.force, communicator),
              dealii::Utilities::MPI::sum(part.moment, communicator)};
    }

    template <int dim>
    Json describe(const Resultant<dim> &resultant)
    {
      Json result;
      for (int d = 0; d < dim; ++d)
        result["force"].push_back(resultant.force[d]);
      for (int d = dim == 2 ? 2 : 0; d < 3; ++d)
        result["moment"].push_back(resultant.moment[d]);
      return result;
    }

    /// Of one condition; @p gross sums up the sizes of the forces [N].
    template <int dim>
    Resultant<dim> integrate(const std::vector<BoundaryFace<dim>> &faces,
                             const BoundaryCondition<dim>         &condition,
                             const double                          time,
                             double                               &gross)
    {
      Resultant<dim> result;
      visit_faces(condition, faces, [&](const BoundaryFace<dim> &face) {
        const auto part = integrate_traction<dim>(condition, face, time, dealii::Point<dim>());
        result.force += part.force;
        result.moment += part.moment;
        gross += part.force.norm();
      });
      return result;
    }

    /// Of nodal forces.
    template <int dim>
    Resultant<dim> add_up(const Nodes<dim> &nodes, const NodalVector &force)
    {
      Resultant<dim> result;
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          dealii::Tensor<1, dim> acting;
          for (int d = 0; d < dim; ++d)
            acting[d] = force.local_element(dim * i + d);
          result.add(nodes.position[i], acting);
        }
      return result;
    }

    /// What the nodes get over what was applied: of the force, or of the moment where the force vanishes.
    template <int dim>
    double ratio_of(const Resultant<dim> &nodal, const Resultant<dim> &applied, const double gross)
    {
      // Far above rounding, far below what any load is meant to have.
      if (applied.force.norm() > 1e-9 * gross)
        return nodal.force * applied.force / applied.force.norm_square();
      return nodal.moment * applied.moment / applied.moment.norm_square();
    }
  } // namespace

  template <int dim>
  Resultant<dim> Simulation<dim>::met_by_ghosts(const std::size_t condition, const double time) const
  {
    Resultant<dim> result;
    visit_faces(scene.loads.conditions[condition],
                scene.ghosts->face_tractions(displacement, scene.loads, time),
                [&](const auto &seen) {
                  dealii::Tensor<1, dim> force = seen.point.area * seen.traction;
                  for (const BoundaryCondition<dim> &other : scene.loads.conditions)
                    for (unsigned int d = 0; d < dim; ++d)
                      if (other.acts_on(seen.boundary) && other.holds(d))
                        force[d] = 0.;
                  result.add(seen.point.position, force);
                });
    return result;
  }

  template <int dim>
  Json Simulation<dim>::load_resultants(const double time) const
  {
    Json           result = {{"conditions", Json::object()}};
    NodalVector    force;
    Resultant<dim> total, by_faces;
    scene.system->initialize(force);
    for (std::size_t k = 0; k < scene.loads.conditions.size(); ++k)
      if (const auto &condition = scene.loads.conditions[k]; condition.prescribes_traction())
        {
          double     gross   = 0;
          const auto applied = sum_of(integrate(scene.faces, condition, time, gross), communicator);
          gross              = dealii::Utilities::MPI::sum(gross, communicator);
          total.force += applied.force;
          total.moment += applied.moment;
          Json &entry      = result["conditions"][condition.name];
          entry["applied"] = describe(applied);
          if (gross == 0)
            continue;
          Loads<dim> alone = scene.loads;
          alone.body_force = {};
          for (std::size_t other = 0; other < alone.conditions.size(); ++other)
            if (other != k)
              {
                alone.conditions[other].traction = {};
                alone.conditions[other].pressure = {};
              }
          if (!scene.ghosts)
            set_tractions(alone, time, force);
          const auto nodal =
            sum_of(scene.ghosts ? met_by_ghosts(k, time) : add_up(*scene.nodes, force), communicator);
          entry["transferred"] = describe(nodal);
          by_faces.force += nodal.force;
          by_faces.moment += nodal.moment;
          entry["ratio"] = ratio_of(nodal, applied, gross);
        }
    Resultant<dim> others;
    for (LocalIndex i = 0; i < scene.nodes->size(); ++i)
      others.add(scene.nodes->position[i],
                 scene.nodes->volume[i] * scene.loads.body_force_at(scene.nodes->position[i], time));
    others = sum_of(others, communicator);
    for (const auto &load : scene.loads.point_loads)
      others.add(load.position, load.force_at(time));
    for (Resultant<dim> *sum : {&total, &by_faces})
      {
        sum->force += others.force;
        sum->moment += others.moment;
      }
    result["total"]["applied"] = describe(total);
    if (scene.ghosts)
      result["total"]["transferred"] = describe(by_faces);
    else
      result["total"]["transferred"] = describe(sum_of(add_up(*scene.nodes, external_force), communicator));
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Simulation)
} // namespace perideal
