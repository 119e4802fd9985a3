// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fem/displacement_constraints.h>
#include <perideal/fem/elastic_fem.h>
#include <perideal/fem/point_evaluation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ElasticFem<dim>::evaluate(const std::vector<dealii::Point<dim>> &points) const
  {
    return PointEvaluation<dim>(geometry, unknowns, displacement).evaluate(points);
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ElasticFem<dim>::evaluate_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const
  {
    Assert(is_on_mesh_itself(), dealii::ExcMessage("the cells are those of the mesh itself only"));
    AssertDimension(point_of_cell.size(), body.triangulation.n_active_cells());

    std::vector<dealii::Tensor<1, dim>>          result(point_of_cell.size());
    const dealii::FiniteElement<dim>            &scalar = element.base_element(0);
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    for (const Cell &cell : unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int       index = cell->active_cell_index();
          const dealii::Point<dim> unit_point =
            geometry.transform_real_to_unit_cell(cell, point_of_cell[index]);
          cell->get_dof_indices(indices);
          for (unsigned int a = 0; a < scalar.n_dofs_per_cell(); ++a)
            {
              const double weight = scalar.shape_value(a, unit_point);
              for (unsigned int d = 0; d < dim; ++d)
                result[index][d] += weight * displacement(indices[element.component_to_system_index(d, a)]);
            }
        }
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim> ElasticFem<dim>::reaction(const dealii::types::boundary_id boundary) const
  {
    const dealii::IndexSet on_boundary =
      dealii::DoFTools::extract_boundary_dofs(unknowns, dealii::ComponentMask(), {boundary});

    // Forces at hanging nodes belong to the nodes they hang on.
    dealii::AffineConstraints<double> hanging(relevant);
    dealii::DoFTools::make_hanging_node_constraints(unknowns, hanging);
    hanging.close();

    CellIntegrals<dim>                           integrals(geometry, element, dim == 2 ? body.thickness : 1.);
    const unsigned int                           n = element.n_dofs_per_cell();
    dealii::FullMatrix<double>                   matrix(n, n);
    dealii::Vector<double>                       forces(n), values(n), residual(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    NodalVector                                  support(right_hand_side);
    support = 0.;
    for (const Cell &cell : unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          // Only cells with a constrained unknown contribute to a held one.
          cell->get_dof_indices(indices);
          if (std::none_of(
                indices.begin(), indices.end(), [&](const auto i) { return held.is_constrained(i); }))
            continue;
          cell_system(cell, integrals, matrix, forces);
          cell->get_dof_values(displacement, values);
          matrix.vmult(residual, values);
          residual -= forces;
          hanging.distribute_local_to_global(residual, indices, support);
        }
    support.compress(dealii::VectorOperation::add);

    dealii::Tensor<1, dim> result;
    const auto            &owned = unknowns.locally_owned_dofs();
    for (const auto index : on_boundary)
      if (owned.is_element(index) && is_held(held, index))
        result[owned.index_within_set(index) % dim] += support(index);
    return dealii::Utilities::MPI::sum(result, unknowns.get_communicator());
  }

#define INSTANTIATE(dim)                                                                                     \
  template std::vector<dealii::Tensor<1, dim>> ElasticFem<dim>::evaluate(                                    \
    const std::vector<dealii::Point<dim>> &) const;                                                          \
  template std::vector<dealii::Tensor<1, dim>> ElasticFem<dim>::evaluate_in_cells(                           \
    const std::vector<dealii::Point<dim>> &) const;                                                          \
  template dealii::Tensor<1, dim> ElasticFem<dim>::reaction(const dealii::types::boundary_id) const
  INSTANTIATE(2);
  INSTANTIATE(3);
#undef INSTANTIATE
} // namespace perideal
