// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>

#include <Eigen/QR>
#include <Eigen/SVD>

#include <cmath>

namespace perideal
{
  dealii::Tensor<2, 3> pseudo_inverse(const dealii::SymmetricTensor<2, 3> &tensor, const double smallest)
  {
    dealii::Tensor<2, 3> result;
    for (const auto &[value, vector] : dealii::eigenvectors(tensor))
      if (value > smallest)
        result += outer_product(vector, vector) / value;
    return result;
  }

  Eigen::MatrixXd solve_by_pseudo_inverse(const Eigen::MatrixXd &matrix,
                                          const Eigen::MatrixXd &right_hand_sides,
                                          const double           tolerance)
  {
    const PseudoInverse<Eigen::MatrixXd> inverse(matrix, tolerance);
    Eigen::MatrixXd                      result(right_hand_sides.rows(), right_hand_sides.cols());
    for (Eigen::Index k = 0; k < result.cols(); ++k)
      result.col(k) = inverse.solve(right_hand_sides.col(k));
    return result;
  }

  template <int dim>
  bool inverse_root(const Eigen::Matrix<double, dim, dim> &matrix,
                    const double                           smallest,
                    Eigen::Matrix<double, dim, dim>       &root)
  {
    using Matrix = Eigen::Matrix<double, dim, dim>;
    // Any root does; the Cholesky factor is the cheapest.
    const Eigen::LLT<Matrix> factor(matrix);
    const Matrix             lower = factor.matrixL();
    if (factor.info() == Eigen::Success && lower.diagonal().cwiseAbs2().minCoeff() > smallest)
      {
        root = lower.template triangularView<Eigen::Lower>().solve(Matrix::Identity());
        return true;
      }
    const Eigen::SelfAdjointEigenSolver<Matrix> spectrum(matrix);
    root = spectrum.eigenvectors().transpose();
    for (int d = 0; d < dim; ++d)
      root.row(d) *= spectrum.eigenvalues()[d] > smallest ? 1. / std::sqrt(spectrum.eigenvalues()[d]) : 0.;
    return false;
  }

  RowInverse invert_rows(const Eigen::MatrixXd &rows, const double tolerance)
  {
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows, Eigen::ComputeFullU | Eigen::ComputeFullV);
    svd.setThreshold(tolerance);
    const Eigen::Index rank = svd.rank();
    RowInverse         result;
    result.inverse = svd.matrixV().leftCols(rank) *
                     svd.singularValues().head(rank).cwiseInverse().asDiagonal() *
                     svd.matrixU().leftCols(rank).transpose();
    result.free = svd.matrixV().rightCols(rows.cols() - rank);
    return result;
  }

  Eigen::VectorXd least_squares(const Eigen::MatrixXd &equations, const Eigen::VectorXd &values)
  {
    return equations.completeOrthogonalDecomposition().solve(values);
  }

  MomentMatrix::MomentMatrix(const unsigned int n_terms)
    : moments(n_terms)
  {
  }

  double MomentMatrix::factorise()
  {
    const double norm = moments.l1_norm();
    // A matrix that is singular to round-off has no Cholesky factor.
    try
      {
        moments.set_property(dealii::LAPACKSupport::symmetric);
        moments.compute_cholesky_factorization();
        return moments.reciprocal_condition_number(norm);
      }
    catch (const dealii::ExceptionBase &)
      {
        return 0;
      }
  }

  PERIDEAL_INSTANTIATE(inverse_root)
} // namespace perideal
