// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/displacement_constraints.h>
#include <perideal/fem/elastic_fem.h>
#include <perideal/fem/point_evaluation.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ElasticFem<dim>::evaluate(const std::vector<dealii::Point<dim>> &points) const
  {
    return PointEvaluation<dim>(space.geometry, space.unknowns, displacement).evaluate(points);
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ElasticFem<dim>::evaluate_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const
  {
    Assert(is_on_mesh_itself(), dealii::ExcMessage("the cells are those of the mesh itself only"));
    AssertDimension(point_of_cell.size(), body.triangulation.n_active_cells());

    return perideal::evaluate_in_cells<dim>(space.geometry, space.unknowns, displacement, point_of_cell);
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  ElasticFem<dim>::gradients_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const
  {
    Assert(is_on_mesh_itself(), dealii::ExcMessage("the cells are those of the mesh itself only"));
    AssertDimension(point_of_cell.size(), body.triangulation.n_active_cells());
    return perideal::gradients_in_cells<dim>(space.geometry, space.unknowns, displacement, point_of_cell);
  }

  template <int dim>
  dealii::Tensor<1, dim> ElasticFem<dim>::reaction(const dealii::types::boundary_id boundary) const
  {
    // Forces at hanging nodes belong to the nodes they hang on.
    dealii::AffineConstraints<double> hanging = space.hanging_nodes();
    hanging.close();

    CellIntegrals<dim>         integrals(space.geometry, space.element, dim == 2 ? body.thickness : 1.);
    const unsigned int         n = space.element.n_dofs_per_cell();
    dealii::FullMatrix<double> matrix(n, n);
    dealii::Vector<double>     forces(n), values(n), residual(n);
    std::vector<dealii::types::global_dof_index> indices(n);
    NodalVector                                  support(right_hand_side);
    support = 0.;
    for (const Cell &cell : space.unknowns.active_cell_iterators())
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

    return sum_of_held(space.unknowns, held, support, boundary);
  }

  PERIDEAL_INSTANTIATE_CLASS(ElasticFem)

} // namespace perideal
