// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_displacement_space_h
#define perideal_fem_displacement_space_h

#include <perideal/base/types.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace perideal
{
  /// Holds the continuous elements of displacements on some cells: their mapping of the same degree, their
  /// unknowns, and which of these this rank needs to know.
  template <int dim>
  struct DisplacementSpace
  {
    /// The cells must outlive this object.
    DisplacementSpace(const dealii::Triangulation<dim> &cells, const unsigned int degree);

    /// Numbers the unknowns. Collective.
    void distribute();

    /// The constraints of hanging nodes, to be added to and closed.
    dealii::AffineConstraints<double> hanging_nodes() const;

    /// A matrix and vectors of this layout. Collective.
    void reinit(dealii::TrilinosWrappers::SparseMatrix  &matrix,
                const dealii::AffineConstraints<double> &held) const;
    void reinit(NodalVector &vector) const;

    dealii::MappingQ<dim>   geometry;
    dealii::FESystem<dim>   element;
    dealii::DoFHandler<dim> unknowns;
    dealii::IndexSet        relevant;
  };
} // namespace perideal

#endif
