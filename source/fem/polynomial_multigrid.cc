// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fem/algebraic_multigrid.h>
#include <perideal/fem/polynomial_multigrid.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/multigrid/mg_transfer_global_coarsening.h>

namespace perideal
{
  template <int dim>
  struct PolynomialMultigrid<dim>::Implementation
  {
    using Matrix   = dealii::TrilinosWrappers::SparseMatrix;
    using Smoother = dealii::PreconditionChebyshev<Matrix, NodalVector, dealii::DiagonalMatrix<NodalVector>>;

    Implementation(const ElasticFem<dim> &quadratic, std::unique_ptr<const ElasticFem<dim>> linear_elements)
      : matrix(quadratic.matrix())
      , linear(std::move(linear_elements))
      , multigrid(*linear, true)
      , residual(quadratic.solution())
      , coarse_source(linear->solution())
      , coarse_solution(linear->solution())
    {
    }

    const Matrix                                &matrix;
    std::unique_ptr<const ElasticFem<dim>>       linear;
    AlgebraicMultigrid<dim>                      multigrid;
    Smoother                                     smoother;
    dealii::MGTwoLevelTransfer<dim, NodalVector> transfer;
    NodalVector                                  residual, coarse_source, coarse_solution;
  };

  template <int dim>
  PolynomialMultigrid<dim>::PolynomialMultigrid(const ElasticFem<dim>                 &quadratic,
                                                std::unique_ptr<const ElasticFem<dim>> linear)
    : implementation(std::make_unique<Implementation>(quadratic, std::move(linear)))
  {
    Implementation &all = *implementation;
    all.transfer.reinit_polynomial_transfer(quadratic.elements().unknowns,
                                            all.linear->elements().unknowns,
                                            quadratic.constraints(),
                                            all.linear->constraints());

    // Two steps over a wide range of eigenvalues: the best of 1 to 5 steps and
    // ranges 4 to 60, in 2-D and 3-D; point smoothers suffer from flat cells.
    typename Implementation::Smoother::AdditionalData options;
    options.degree          = 2;
    options.smoothing_range = 40.;
    options.preconditioner  = std::make_shared<dealii::DiagonalMatrix<NodalVector>>();
    NodalVector &inverse    = options.preconditioner->get_vector();
    inverse.reinit(all.residual);
    for (const auto i : inverse.locally_owned_elements())
      inverse(i) = 1. / all.matrix.diag_element(i);
    all.smoother.initialize(all.matrix, options);
  }

  template <int dim>
  PolynomialMultigrid<dim>::~PolynomialMultigrid() = default;

  template <int dim>
  void PolynomialMultigrid<dim>::vmult(NodalVector &destination, const NodalVector &source) const
  {
    Implementation &all = *implementation;
    all.smoother.vmult(destination, source);
    all.matrix.vmult(all.residual, destination);
    all.residual.sadd(-1., 1., source);
    all.coarse_source = 0.;
    all.transfer.restrict_and_add(all.coarse_source, all.residual);
    all.multigrid.vmult(all.coarse_solution, all.coarse_source);
    all.transfer.prolongate_and_add(destination, all.coarse_solution);
    all.smoother.step(destination, source);
  }

  PERIDEAL_INSTANTIATE_CLASS(PolynomialMultigrid)
} // namespace perideal
