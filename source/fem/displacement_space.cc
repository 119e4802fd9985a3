// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/displacement_space.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

namespace perideal
{
  template <int dim>
  DisplacementSpace<dim>::DisplacementSpace(const dealii::Triangulation<dim> &cells,
                                            const unsigned int                degree)
    : geometry(degree)
    , element(dealii::FE_Q<dim>(degree), dim)
    , unknowns(cells)
  {
  }

  template <int dim>
  void DisplacementSpace<dim>::distribute()
  {
    unknowns.distribute_dofs(element);
    dealii::DoFTools::extract_locally_relevant_dofs(unknowns, relevant);
  }

  template <int dim>
  dealii::AffineConstraints<double> DisplacementSpace<dim>::hanging_nodes() const
  {
    dealii::AffineConstraints<double> result(relevant);
    dealii::DoFTools::make_hanging_node_constraints(unknowns, result);
    return result;
  }

  template <int dim>
  void DisplacementSpace<dim>::reinit(dealii::TrilinosWrappers::SparseMatrix  &matrix,
                                      const dealii::AffineConstraints<double> &held) const
  {
    const dealii::IndexSet                   &owned = unknowns.locally_owned_dofs();
    dealii::TrilinosWrappers::SparsityPattern sparsity(owned, owned, relevant, unknowns.get_communicator());
    dealii::DoFTools::make_sparsity_pattern(unknowns, sparsity, held, false);
    sparsity.compress();
    matrix.reinit(sparsity);
  }

  template <int dim>
  void DisplacementSpace<dim>::reinit(NodalVector &vector) const
  {
    vector.reinit(unknowns.locally_owned_dofs(), relevant, unknowns.get_communicator());
  }

  PERIDEAL_INSTANTIATE_CLASS(DisplacementSpace)
} // namespace perideal
