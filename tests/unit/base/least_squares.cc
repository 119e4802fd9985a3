// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/least_squares.h>

#include <gtest/gtest.h>

using namespace perideal;

namespace
{
  using Matrix = Eigen::Matrix3d;
  using Vector = Eigen::Vector3d;

  /// With the eigenvalues 0, 2 and 5.
  Matrix singular()
  {
    const Vector a = Vector(1, 2, 2) / 3, b = Vector(2, 1, -2) / 3;
    return 2. * a * a.transpose() + 5. * b * b.transpose();
  }
} // namespace

TEST(LeastSquares, PseudoInverseMeetsPenrosesConditions)
{
  const Matrix                a = singular();
  const PseudoInverse<Matrix> inverse(a, 1e-10);
  const Matrix                b = inverse.matrix();
  EXPECT_EQ(inverse.n_null(), 1);
  EXPECT_LT((a * b * a - a).norm(), 1e-14);
  EXPECT_LT((b * a * b - b).norm(), 1e-14);
  EXPECT_LT((a * b - (a * b).transpose()).norm(), 1e-14);
  EXPECT_LT((inverse.solve(Vector(1, -2, 3)) - b * Vector(1, -2, 3)).norm(), 1e-14);
  EXPECT_LT((a * inverse.null_vector(0)).norm(), 1e-14);
  EXPECT_NEAR(inverse.null_vector(0).norm(), 1., 1e-14);

  dealii::SymmetricTensor<2, 3> tensor;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i; j < 3; ++j)
      tensor[i][j] = a(i, j);
  const auto of_tensor = pseudo_inverse(tensor, 1e-10);
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      EXPECT_NEAR(of_tensor[i][j], b(i, j), 1e-14);
}

TEST(LeastSquares, RanksDropAtTheTolerance)
{
  const Matrix a = Vector(1e-6, 1., 2.).asDiagonal();
  EXPECT_EQ(PseudoInverse<Matrix>(a, 1e-7).n_null(), 0);
  EXPECT_EQ(PseudoInverse<Matrix>(a, 1e-6).n_null(), 1);
  EXPECT_EQ(PseudoInverse<Matrix>(Matrix::Zero(), 1e-6).n_null(), 3);
}

TEST(LeastSquares, SemidefiniteSystemsHaveTheirSmallestSolution)
{
  const Vector right = singular() * Vector(1, 2, 3);
  const Vector x     = solve_semidefinite(singular(), right, 1e-10);
  EXPECT_LT((singular() * x - right).norm(), 1e-13);
  EXPECT_NEAR(x.dot(PseudoInverse<Matrix>(singular(), 1e-10).null_vector(0)), 0., 1e-14);
  const Matrix regular = singular() + Matrix::Identity();
  EXPECT_LT((regular * solve_semidefinite(regular, right, 1e-10) - right).norm(), 1e-13);
}

TEST(LeastSquares, RootsOfTheInverseLeaveOutFlatDirections)
{
  Matrix root;
  EXPECT_FALSE(inverse_root<3>(singular(), 1e-10, root));
  const Matrix image = root * singular() * root.transpose();
  EXPECT_LT((image - Matrix(Vector(0, 1, 1).asDiagonal())).norm(), 1e-13);
  EXPECT_EQ(root.row(0).norm(), 0.);
  const Matrix regular = singular() + Matrix::Identity();
  EXPECT_TRUE(inverse_root<3>(regular, 1e-10, root));
  EXPECT_LT((root * regular * root.transpose() - Matrix::Identity()).norm(), 1e-13);
}

TEST(LeastSquares, RowsLeaveTheRestFree)
{
  Eigen::MatrixXd rows(3, 4);
  rows << 1, 2, 0, 1, 0, 1, 1, 0, 1, 3, 1, 1;
  const RowInverse found = invert_rows(rows, 1e-10);
  EXPECT_EQ(found.free.cols(), 2);
  EXPECT_LT((rows * found.free).norm(), 1e-14);
  EXPECT_LT((rows * found.inverse * rows - rows).norm(), 1e-14);
}

TEST(LeastSquares, EquationsAreMetBest)
{
  // A line through three points, and a direction that no equation knows.
  Eigen::MatrixXd equations(3, 3);
  equations << 1, 0, 0, 1, 1, 0, 1, 2, 0;
  const Eigen::VectorXd x = least_squares(equations, Eigen::Vector3d(0, 1, 5));
  EXPECT_NEAR(x[0], -0.5, 1e-14);
  EXPECT_NEAR(x[1], 2.5, 1e-14);
  EXPECT_NEAR(x[2], 0., 1e-14);
}

TEST(LeastSquares, MomentsTellTheirCondition)
{
  MomentMatrix moments(2);
  moments.add({1., 0.}, 2.);
  EXPECT_EQ(moments.factorise(), 0.);
  moments.clear();
  moments.add({1., 0.}, 2.);
  moments.add({0., 1.}, 0.5);
  EXPECT_NEAR(moments.factorise(), 0.25, 1e-14);
  dealii::Vector<double> x(2);
  x(0) = x(1) = 1.;
  moments.solve(x);
  EXPECT_NEAR(x(0), 0.5, 1e-14);
  EXPECT_NEAR(x(1), 2., 1e-14);
}
