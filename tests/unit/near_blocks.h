// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_near_blocks_h
#define perideal_tests_unit_near_blocks_h

#include <deal.II/base/tensor.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace perideal::test
{
  /// Expects that a block preconditions that on the diagonal well: the eigenvalues of the latter, seen by the
  /// former, lie between .6 and 1.6.
  template <int dim>
  void expect_preconditions(const dealii::Tensor<2, dim> &block, const dealii::Tensor<2, dim> &of_diagonal)
  {
    Eigen::Matrix<double, dim, dim> metric, matrix;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        {
          metric(a, b) = block[a][b];
          matrix(a, b) = of_diagonal[a][b];
        }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix<double, dim, dim>> solver(matrix, metric);
    EXPECT_GT(solver.eigenvalues().minCoeff(), 0.6);
    EXPECT_LT(solver.eigenvalues().maxCoeff(), 1.6);
  }
} // namespace perideal::test

#endif
