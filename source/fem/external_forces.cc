// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/external_forces.h>
#include <perideal/mesh/point_location.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  ExternalForces<dim>::ExternalForces(const Mesh<dim> &mesh, const Loads<dim> &loads)
    : loads(loads)
    , has_body_force(loads.has_body_force())
  {
    for (const BoundaryCondition<dim> &condition : loads.conditions)
      for (const std::string &boundary : condition.boundaries)
        {
          const auto id = mesh.boundary_id(boundary, "Boundary conditions/" + condition.name + "/Boundary");
          if (condition.prescribes_traction())
            tractions.emplace(id, &condition);
          if (condition.spring.stiffness > 0)
            springs.emplace(id, condition.spring);
        }
  }

  template <int dim>
  void ExternalForces<dim>::reinit(const dealii::Triangulation<dim> &cells,
                                   const dealii::Mapping<dim>       &mapping,
                                   const double                      time)
  {
    this->time = time;
    point_forces.clear();
    if (loads.point_loads.empty())
      return;
    std::vector<dealii::Point<dim>> points;
    for (const PointLoad<dim> &load : loads.point_loads)
      points.push_back(load.position);
    std::vector<double> distances;
    const auto          places = PointLocation<dim>(cells, mapping).share(points, distances);
    for (std::size_t p = 0; p < points.size(); ++p)
      for (const auto &at : places[p])
        point_forces.insert({at.place.cell->active_cell_index(),
                             {at.place.unit_point, loads.point_loads[p].force_at(time) / at.n_sharing}});
  }

  template <int dim>
  void ExternalForces<dim>::add(const Cell             &cell,
                                CellIntegrals<dim>     &integrals,
                                dealii::Vector<double> &forces) const
  {
    if (has_body_force)
      integrals.add_body_force(
        cell,
        [&](const dealii::Point<dim> &point) {
          return loads.body_force_at(point, time, cell->material_id());
        },
        forces);
    if (!tractions.empty() && cell->at_boundary())
      for (const unsigned int face : cell->face_indices())
        if (cell->face(face)->at_boundary())
          {
            const auto acting = tractions.equal_range(cell->face(face)->boundary_id());
            for (auto entry = acting.first; entry != acting.second; ++entry)
              integrals.add_traction(
                cell,
                face,
                [&](const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &normal) {
                  return Loads<dim>::traction(*entry->second, point, normal, time);
                },
                forces);
          }
    const dealii::FiniteElement<dim> &element = cell->get_fe();
    const auto                        acting  = point_forces.equal_range(cell->active_cell_index());
    for (auto entry = acting.first; entry != acting.second; ++entry)
      for (unsigned int k = 0; k < forces.size(); ++k)
        forces[k] += element.shape_value(k, entry->second.unit_point) *
                     entry->second.force[element.system_to_component_index(k).first];
  }

  template <int dim>
  void ExternalForces<dim>::add_springs(const Cell                 &cell,
                                        CellIntegrals<dim>         &integrals,
                                        dealii::FullMatrix<double> &matrix) const
  {
    if (springs.empty() || !cell->at_boundary())
      return;
    for (const unsigned int face : cell->face_indices())
      if (cell->face(face)->at_boundary())
        {
          const auto holding = springs.equal_range(cell->face(face)->boundary_id());
          for (auto entry = holding.first; entry != holding.second; ++entry)
            integrals.add_springs(
              cell,
              face,
              [&](const dealii::Tensor<1, dim> &normal) { return entry->second.in(normal); },
              matrix);
        }
  }

  PERIDEAL_INSTANTIATE_CLASS(ExternalForces)
} // namespace perideal
