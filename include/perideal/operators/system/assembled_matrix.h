// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_assembled_matrix_h
#define perideal_operators_system_assembled_matrix_h

#include <perideal/operators/system/constrained_operator.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

namespace perideal
{
  /**
   * Assembles the matrix of a constrained operator, for direct solvers, tests and small
   * problems: a row has an entry for every node within two bonds. Held rows
   * carry a diagonal of the size of the others. Collective.
   */
  template <int dim>
  void assemble_matrix(const ConstrainedOperator<dim>         &system,
                       dealii::TrilinosWrappers::SparseMatrix &matrix);
} // namespace perideal

#endif
