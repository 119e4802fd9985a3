// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/face_tractions.h>
#include <perideal/problem/loading.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <optional>

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

    /// What the nodes get over what was applied: of the force, or of the moment where the force vanishes;
    /// nothing where both do.
    /// @param gross sum of the sizes of the forces [N]
    /// @param size of the body [m]
    template <int dim>
    std::optional<double> ratio_of(const Resultant<dim> &nodal,
                                   const Resultant<dim> &applied,
                                   const double          gross,
                                   const double          size)
    {
      // Far above rounding, far below what any load is meant to have.
      if (applied.force.norm() > 1e-9 * gross)
        return nodal.force * applied.force / applied.force.norm_square();
      if (applied.moment.norm() > 1e-9 * gross * size)
        return nodal.moment * applied.moment / applied.moment.norm_square();
      return {};
    }
  } // namespace

  template <int dim>
  Json Loading<dim>::resultants(const NodalVector &displacement,
                                const NodalVector &external,
                                const double       time) const
  {
    const Nodes<dim> &nodes        = *body.nodes;
    const MPI_Comm    communicator = nodes.communicator;
    Json              result       = {{"conditions", Json::object()}};
    Resultant<dim>    total, by_faces;
    for (unsigned int k = 0; k < loads.conditions.size(); ++k)
      if (const auto &condition = loads.conditions[k]; condition.prescribes_traction())
        {
          double     gross   = 0;
          const auto applied = sum_of(integrate(body.faces, condition, time, gross), communicator);
          gross              = dealii::Utilities::MPI::sum(gross, communicator);
          total.force += applied.force;
          total.moment += applied.moment;
          Json &entry      = result["conditions"][condition.name];
          entry["applied"] = describe(applied);
          if (gross == 0)
            continue;
          const auto nodal     = sum_of(tractions->resultant(k, time, displacement), communicator);
          entry["transferred"] = describe(nodal);
          by_faces.force += nodal.force;
          by_faces.moment += nodal.moment;
          if (const auto ratio = ratio_of(nodal, applied, gross, body.box[0].distance(body.box[1])))
            entry["ratio"] = *ratio;
        }
    Resultant<dim> others;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      others.add(nodes.position[i],
                 nodes.volume[i] * loads.body_force_at(nodes.position[i], time, nodes.material[i]));
    others = sum_of(others, communicator);
    for (const auto &load : loads.point_loads)
      others.add(load.position, load.force_at(time));
    for (Resultant<dim> *sum : {&total, &by_faces})
      {
        sum->force += others.force;
        sum->moment += others.moment;
      }
    result["total"]["applied"] = describe(total);
    result["total"]["transferred"] =
      describe(tractions->are_nodal_forces() ? sum_of(tractions->add_up(external), communicator) : by_faces);
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Loading)
} // namespace perideal
