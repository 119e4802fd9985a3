// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_algebraic_multigrid_h
#define perideal_fem_algebraic_multigrid_h

#include <perideal/base/types.h>
#include <perideal/fem/elastic_fem.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>

namespace perideal
{
  /**
   * Applies one cycle of smoothed-aggregation multigrid (Trilinos ML) on an elasticity
   * matrix, with all rigid-body motions as near-null space.
   */
  template <int dim>
  class AlgebraicMultigrid
  {
  public:
    /// @param fem an assembled problem, which must outlive this object
    /// @param finest_sweeps degree of the Chebyshev smoother on the finest level, 1 or 2
    AlgebraicMultigrid(const ElasticFem<dim> &fem, const unsigned int finest_sweeps = 2);

    /// The same for the matrix of any linear or quadratic elements, which must outlive this object.
    AlgebraicMultigrid(const dealii::Mapping<dim>                   &mapping,
                       const dealii::DoFHandler<dim>                &unknowns,
                       const dealii::AffineConstraints<double>      &constraints,
                       const dealii::TrilinosWrappers::SparseMatrix &matrix,
                       const unsigned int                            finest_sweeps = 2);

    /// The same for a matrix with dim consecutive unknowns at each of this rank's points [m].
    /// @param held by owned unknown
    /// @param weakest_coupling over the diagonal [-]: aggregates do not join unknowns of weaker ones
    AlgebraicMultigrid(const std::vector<dealii::Point<dim>>        &points,
                       const std::vector<bool>                      &held,
                       const dealii::TrilinosWrappers::SparseMatrix &matrix,
                       const unsigned int                            finest_sweeps,
                       const double                                  weakest_coupling = 0.);
    ~AlgebraicMultigrid();

    /// Approximates the inverse of the matrix applied to @p source. The vectors
    /// are distributed like the rows of the matrix; ghosts are neither used nor set.
    void vmult(NodalVector &destination, const NodalVector &source) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace perideal

#endif
