// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/cell_expansion.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

namespace perideal
{
  template <int dim>
  void CellExpansion<dim>::set(const Mesh<dim>  &mesh,
                               const Nodes<dim> &nodes,
                               const Loads<dim> &loads,
                               const double      time)
  {
    const dealii::FE_Nothing<dim> no_shape;
    dealii::FEValues<dim>         values(
      no_shape, dealii::QGauss<dim>(3), dealii::update_quadrature_points | dealii::update_JxW_values);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          const LocalIndex       i      = nodes.node_of_cell[cell->active_cell_index()];
          double                 volume = 0, sum = 0;
          dealii::Tensor<1, dim> place, product;
          for (const unsigned int q : values.quadrature_point_indices())
            {
              const dealii::Point<dim> &point     = values.quadrature_point(q);
              const double              expansion = loads.expansion_at(point, time, cell->material_id());
              volume += values.JxW(q);
              sum += values.JxW(q) * expansion;
              // From the first vertex, so that nothing cancels far from the origin.
              const auto arm = point - cell->vertex(0);
              place += values.JxW(q) * arm;
              product += (values.JxW(q) * expansion) * arm;
            }
          mean[i]   = sum / volume;
          moment[i] = mesh.thickness * (product - mean[i] * place);
        }
  }

  PERIDEAL_INSTANTIATE_CLASS(CellExpansion)
} // namespace perideal
