// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/fem/displacement_constraints.h>
#include <perideal/fem/elastic_fem.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/numerics/vector_tools_evaluate.h>

#include <sstream>

namespace perideal
{
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ElasticFem<dim>::evaluate(const std::vector<dealii::Point<dim>> &points) const
  {
    std::vector<dealii::Tensor<1, dim>> result(points.size());
    std::vector<std::size_t>            wanted(points.size());
    std::iota(wanted.begin(), wanted.end(), 0);

    const MPI_Comm communicator = unknowns.get_communicator();
    // The tolerance is a distance in unit-cell coordinates.
    for (const double tolerance : {1e-6, 1e-1})
      {
        std::vector<dealii::Point<dim>> wanted_points(wanted.size());
        std::transform(wanted.begin(), wanted.end(), wanted_points.begin(), [&](const std::size_t i) {
          return points[i];
        });
        dealii::Utilities::MPI::RemotePointEvaluation<dim> search(tolerance, true);
        search.reinit(wanted_points, unknowns.get_triangulation(), geometry);
        const auto values = dealii::VectorTools::point_values<dim>(search, unknowns, displacement);

        std::vector<std::size_t> lost;
        for (unsigned int k = 0; k < wanted.size(); ++k)
          if (search.point_found(k))
            result[wanted[k]] = values[k];
          else
            lost.push_back(wanted[k]);
        wanted = lost;
        if (dealii::Utilities::MPI::max<unsigned int>(wanted.size(), communicator) == 0)
          return result;
      }

    std::ostringstream message;
    message << "the finite-element solution is asked for at a point outside the body";
    if (!wanted.empty())
      message << ": (" << points[wanted.front()] << ")";
    throw ComputationError(message.str());
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  ElasticFem<dim>::evaluate_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const
  {
    Assert(refined == nullptr, dealii::ExcMessage("the cells are those of the mesh itself only"));
    AssertDimension(point_of_cell.size(), mesh.triangulation.n_active_cells());

    std::vector<dealii::Tensor<1, dim>>          result(point_of_cell.size());
    const dealii::FiniteElement<dim>            &scalar = element.base_element(0);
    std::vector<dealii::types::global_dof_index> indices(element.n_dofs_per_cell());
    for (const Cell &cell : unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const unsigned int       index      = cell->active_cell_index();
          const dealii::Point<dim> unit_point = geometry.transform_real_to_unit_cell(cell, point_of_cell[index]);
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

    CellIntegrals<dim>                           integrals(geometry, element, dim == 2 ? mesh.thickness : 1.);
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
          if (std::none_of(indices.begin(), indices.end(), [&](const auto i) { return held.is_constrained(i); }))
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
