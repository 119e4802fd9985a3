// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/fem/displacement_constraints.h>
#include <perideal/fem/hyperelastic_fem.h>
#include <perideal/fem/point_evaluation.h>

#include <deal.II/base/mpi.h>

namespace perideal
{
  template <int dim>
  HyperelasticFem<dim>::HyperelasticFem(const Mesh<dim>           &mesh,
                                        const Loads<dim>          &loads,
                                        const LawsByMaterial<dim> &laws,
                                        const Controls            &controls)
    : body(mesh)
    , loads(loads)
    , laws(laws)
    , controls(controls)
    , thickness(dim == 2 ? mesh.thickness : 1.)
    , external(mesh, loads)
    , space(mesh.triangulation, 1)
  {
    space.distribute();
    hanging = space.hanging_nodes();
    hanging.close();
    prescribe(0.);

    // Which unknowns are held does not change with time.
    space.reinit(stiffness, held);
    for (NodalVector *vector :
         {&fields.displacement, &fields.external_force, &fields.balance, &fields.correction})
      space.reinit(*vector);
    fields.displacement.update_ghost_values();
  }

  template <int dim>
  void HyperelasticFem<dim>::prescribe(const double time)
  {
    held = space.hanging_nodes();
    add_prescribed_displacements(space.geometry, space.unknowns, body, loads, time, held);
    pin_free_motions(space.geometry, space.unknowns, body, loads, held);
    held.close();
  }

  template <int dim>
  typename HyperelasticFem<dim>::Constraints HyperelasticFem<dim>::increments(const bool moving) const
  {
    Constraints result = space.hanging_nodes();
    for (const auto index : space.relevant)
      if (is_held(held, index) && !result.is_constrained(index))
        {
          result.add_line(index);
          if (moving)
            result.set_inhomogeneity(index, held.get_inhomogeneity(index) - fields.displacement(index));
        }
    result.close();
    return result;
  }

  template <int dim>
  void HyperelasticFem<dim>::for_each_cell(const Visit &visit) const
  {
    const unsigned int                           n = space.element.n_dofs_per_cell();
    std::vector<dealii::types::global_dof_index> indices(n);
    dealii::Vector<double>                       values(n);
    for (const Cell &cell : space.unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto law = laws.find(cell->material_id());
          // Not an Assert: in Release a body without stiffness would come out, silently.
          AssertThrow(law != laws.end(),
                      dealii::ExcMessage("no law for material id " + std::to_string(cell->material_id())));
          cell->get_dof_indices(indices);
          cell->get_dof_values(fields.displacement, values);
          visit(cell, *law->second, indices, values);
        }
  }

  template <int dim>
  void HyperelasticFem<dim>::make_external_force(const double time)
  {
    external.reinit(space.unknowns.get_triangulation(), space.geometry, time);
    CellIntegrals<dim>     integrals(space.geometry, space.element, thickness);
    dealii::Vector<double> forces(space.element.n_dofs_per_cell());
    fields.external_force = 0.;
    for_each_cell([&](const Cell &cell, const auto &, const auto &indices, const auto &) {
      forces = 0.;
      external.add(cell, integrals, forces);
      hanging.distribute_local_to_global(forces, indices, fields.external_force);
    });
    fields.external_force.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void HyperelasticFem<dim>::compute_balance()
  {
    FiniteStrainIntegrals<dim> integrals(space.geometry, space.element, thickness);
    dealii::Vector<double>     forces(space.element.n_dofs_per_cell());
    fields.balance = 0.;
    for_each_cell([&](const Cell &cell, const auto &law, const auto &indices, const auto &values) {
      integrals.reinit(cell, values);
      forces = 0.;
      integrals.subtract_forces(law, forces);
      hanging.distribute_local_to_global(forces, indices, fields.balance);
    });
    fields.balance.compress(dealii::VectorOperation::add);
    fields.balance += fields.external_force;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  HyperelasticFem<dim>::evaluate(const std::vector<dealii::Point<dim>> &points) const
  {
    return PointEvaluation<dim>(space.geometry, space.unknowns, fields.displacement).evaluate(points);
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  HyperelasticFem<dim>::evaluate_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const
  {
    return perideal::evaluate_in_cells<dim>(
      space.geometry, space.unknowns, fields.displacement, point_of_cell);
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>>
  HyperelasticFem<dim>::gradients_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const
  {
    return perideal::gradients_in_cells<dim>(
      space.geometry, space.unknowns, fields.displacement, point_of_cell);
  }

  template <int dim>
  dealii::Tensor<1, dim> HyperelasticFem<dim>::reaction(const dealii::types::boundary_id boundary) const
  {
    return -sum_of_held(space.unknowns, held, fields.balance, boundary);
  }

  template <int dim>
  double HyperelasticFem<dim>::strain_energy() const
  {
    FiniteStrainIntegrals<dim> integrals(space.geometry, space.element, thickness);
    double                     result = 0;
    for_each_cell([&](const Cell &cell, const auto &law, const auto &, const auto &values) {
      integrals.reinit(cell, values);
      result += integrals.energy(law);
    });
    return dealii::Utilities::MPI::sum(result, space.unknowns.get_communicator());
  }

  PERIDEAL_INSTANTIATE_CLASS(HyperelasticFem)

} // namespace perideal
