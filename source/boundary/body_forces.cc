// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/body_forces.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

namespace perideal
{
  template <int dim>
  void
  set_body_forces(const Nodes<dim> &nodes, const Loads<dim> &loads, const double time, NodalVector &force)
  {
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        const auto body_force = loads.body_force_at(nodes.position[i], time, nodes.material[i]);
        for (int d = 0; d < dim; ++d)
          force.local_element(dim * i + d) = body_force[d] * nodes.volume[i];
      }
  }

  template <int dim>
  std::vector<BodyForce<dim>> integrate_body_forces(const Mesh<dim>                       &mesh,
                                                    const Nodes<dim>                      &nodes,
                                                    const std::vector<dealii::Point<dim>> &about,
                                                    const Loads<dim>                      &loads,
                                                    const double                           time)
  {
    std::vector<BodyForce<dim>>   result(nodes.size());
    const dealii::FE_Nothing<dim> no_shape;
    dealii::FEValues<dim>         values(
      no_shape, dealii::QGauss<dim>(3), dealii::update_quadrature_points | dealii::update_JxW_values);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const LocalIndex i = nodes.node_of_cell[cell->active_cell_index()];
          values.reinit(cell);
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const auto &point = values.quadrature_point(q);
              const auto  force =
                mesh.thickness * values.JxW(q) * loads.body_force_at(point, time, cell->material_id());
              result[i].force += force;
              result[i].moment += outer_product(force, point - about[i]);
            }
        }
    return result;
  }

  PERIDEAL_INSTANTIATE(set_body_forces)
  PERIDEAL_INSTANTIATE(integrate_body_forces)
} // namespace perideal
