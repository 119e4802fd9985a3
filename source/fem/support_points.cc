// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/support_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <limits>

namespace perideal
{
  template <int dim>
  std::vector<dealii::Point<dim>> owned_support_points(const dealii::Mapping<dim>    &mapping,
                                                       const dealii::DoFHandler<dim> &unknowns)
  {
    const dealii::FiniteElement<dim> &element = unknowns.get_fe();
    const dealii::FiniteElement<dim> &scalar  = element.base_element(0);
    AssertThrow(scalar.degree <= 2, dealii::ExcNotImplemented());

    const dealii::Quadrature<dim> unit_points(scalar.get_unit_support_points());
    dealii::FEValues<dim>         values(mapping, scalar, unit_points, dealii::update_quadrature_points);

    const dealii::IndexSet                      &owned = unknowns.locally_owned_dofs();
    std::vector<dealii::Point<dim>>              points(owned.n_elements() / dim);
    std::vector<bool>                            known(points.size(), false);
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    const auto                                   first = owned.is_empty() ? 0 : *owned.begin();

    for (const auto &cell : unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(indices);
          bool mapped = false;
          for (unsigned int a = 0; a < unit_points.size(); ++a)
            {
              const auto index = indices[element.component_to_system_index(0, a)];
              if (!owned.is_element(index))
                continue;
              Assert(indices[element.component_to_system_index(dim - 1, a)] == index + dim - 1,
                     dealii::ExcInternalError());
              const auto point = (index - first) / dim;
              if (known[point])
                continue;
              if (scalar.degree == 1)
                points[point] = cell->vertex(a);
              else
                {
                  if (!mapped)
                    values.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell));
                  mapped        = true;
                  points[point] = values.quadrature_point(a);
                }
              known[point] = true;
            }
        }
    return points;
  }

  template <int dim>
  RigidBodyMotions<dim> motions_about_middle(const std::vector<dealii::Point<dim>> &points,
                                             MPI_Comm                               communicator)
  {
    std::array<double, dim> lowest, highest;
    lowest.fill(std::numeric_limits<double>::max());
    highest.fill(std::numeric_limits<double>::lowest());
    for (const dealii::Point<dim> &point : points)
      for (unsigned int d = 0; d < dim; ++d)
        {
          lowest[d]  = std::min(lowest[d], point[d]);
          highest[d] = std::max(highest[d], point[d]);
        }
    dealii::Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = dealii::Utilities::MPI::min(lowest[d], communicator);
        upper[d] = dealii::Utilities::MPI::max(highest[d], communicator);
      }
    return RigidBodyMotions<dim>(lower + 0.5 * (upper - lower), 0.5 * lower.distance(upper));
  }

  PERIDEAL_INSTANTIATE(owned_support_points)
  PERIDEAL_INSTANTIATE(motions_about_middle)
} // namespace perideal
