// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/fem/displacement_constraints.h>
#include <perideal/fem/hyperelastic_fem.h>
#include <perideal/fem/point_evaluation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

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
    , geometry(1)
    , element(dealii::FE_Q<dim>(1), dim)
    , unknowns(mesh.triangulation)
  {
    unknowns.distribute_dofs(element);
    dealii::DoFTools::extract_locally_relevant_dofs(unknowns, relevant);
    hanging.reinit(relevant);
    dealii::DoFTools::make_hanging_node_constraints(unknowns, hanging);
    hanging.close();
    prescribe(0.);

    // Which unknowns are held does not change with time.
    const dealii::IndexSet &owned        = unknowns.locally_owned_dofs();
    const MPI_Comm          communicator = unknowns.get_communicator();

    dealii::TrilinosWrappers::SparsityPattern sparsity(owned, owned, relevant, communicator);
    dealii::DoFTools::make_sparsity_pattern(unknowns, sparsity, held, false);
    sparsity.compress();
    stiffness.reinit(sparsity);
    for (NodalVector *vector : {&displacement, &external_force, &balance, &correction})
      vector->reinit(owned, relevant, communicator);
    displacement.update_ghost_values();
  }

  template <int dim>
  void HyperelasticFem<dim>::prescribe(const double time)
  {
    held.reinit(relevant);
    dealii::DoFTools::make_hanging_node_constraints(unknowns, held);
    add_prescribed_displacements(geometry, unknowns, body, loads, time, held);
    pin_free_motions(geometry, unknowns, held);
    held.close();
  }

  template <int dim>
  typename HyperelasticFem<dim>::Constraints HyperelasticFem<dim>::increments(const bool moving) const
  {
    Constraints result(relevant);
    dealii::DoFTools::make_hanging_node_constraints(unknowns, result);
    for (const auto index : relevant)
      if (is_held(held, index) && !result.is_constrained(index))
        {
          result.add_line(index);
          if (moving)
            result.set_inhomogeneity(index, held.get_inhomogeneity(index) - displacement(index));
        }
    result.close();
    return result;
  }

  template <int dim>
  void HyperelasticFem<dim>::for_each_cell(const Visit &visit) const
  {
    const unsigned int                           n = element.n_dofs_per_cell();
    std::vector<dealii::types::global_dof_index> indices(n);
    dealii::Vector<double>                       values(n);
    for (const Cell &cell : unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto law = laws.find(cell->material_id());
          // Not an Assert: in Release a body without stiffness would come out, silently.
          AssertThrow(law != laws.end(),
                      dealii::ExcMessage("no law for material id " + std::to_string(cell->material_id())));
          cell->get_dof_indices(indices);
          cell->get_dof_values(displacement, values);
          visit(cell, *law->second, indices, values);
        }
  }

  template <int dim>
  void HyperelasticFem<dim>::make_external_force(const double time)
  {
    external.reinit(unknowns.get_triangulation(), geometry, time);
    CellIntegrals<dim>     integrals(geometry, element, thickness);
    dealii::Vector<double> forces(element.n_dofs_per_cell());
    external_force = 0.;
    for_each_cell([&](const Cell &cell, const auto &, const auto &indices, const auto &) {
      forces = 0.;
      external.add(cell, integrals, forces);
      hanging.distribute_local_to_global(forces, indices, external_force);
    });
    external_force.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void HyperelasticFem<dim>::compute_balance()
  {
    FiniteStrainIntegrals<dim> integrals(geometry, element, thickness);
    dealii::Vector<double>     forces(element.n_dofs_per_cell());
    balance = 0.;
    for_each_cell([&](const Cell &cell, const auto &law, const auto &indices, const auto &values) {
      integrals.reinit(cell, values);
      forces = 0.;
      integrals.subtract_forces(law, forces);
      hanging.distribute_local_to_global(forces, indices, balance);
    });
    balance.compress(dealii::VectorOperation::add);
    balance += external_force;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  HyperelasticFem<dim>::evaluate(const std::vector<dealii::Point<dim>> &points) const
  {
    return PointEvaluation<dim>(geometry, unknowns, displacement).evaluate(points);
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  HyperelasticFem<dim>::evaluate_in_cells(const std::vector<dealii::Point<dim>> &point_of_cell) const
  {
    return perideal::evaluate_in_cells<dim>(geometry, unknowns, displacement, point_of_cell);
  }

  template <int dim>
  dealii::Tensor<1, dim> HyperelasticFem<dim>::reaction(const dealii::types::boundary_id boundary) const
  {
    return -sum_of_held(unknowns, held, balance, boundary);
  }

  template <int dim>
  double HyperelasticFem<dim>::strain_energy() const
  {
    FiniteStrainIntegrals<dim> integrals(geometry, element, thickness);
    double                     result = 0;
    for_each_cell([&](const Cell &cell, const auto &law, const auto &, const auto &values) {
      integrals.reinit(cell, values);
      result += integrals.energy(law);
    });
    return dealii::Utilities::MPI::sum(result, unknowns.get_communicator());
  }

  PERIDEAL_INSTANTIATE_CLASS(HyperelasticFem)

} // namespace perideal
