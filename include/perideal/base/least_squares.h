// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_least_squares_h
#define perideal_base_least_squares_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <vector>

namespace perideal
{
  /**
   * Inverts a symmetric, positive semi-definite matrix, such as that of the normal equations of a fit, in the
   * directions in which it has an inverse. Eigenvalues that are at most tolerance times the largest one count
   * as zero. A matrix of the squares of singular values takes the square of their tolerance.
   */
  template <typename Matrix>
  class PseudoInverse
  {
  public:
    using Vector = Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1>;

    PseudoInverse(const Matrix &matrix, const double tolerance)
      : spectrum(matrix)
      , inverted(spectrum.eigenvalues())
    {
      const double smallest = tolerance * inverted[inverted.size() - 1];
      for (Eigen::Index k = 0; k < inverted.size(); ++k)
        {
          const bool counts = inverted[k] > smallest;
          inverted[k]       = counts ? 1. / inverted[k] : 0.;
          n_free += !counts;
        }
    }

    /// How many eigenvalues count as zero.
    Eigen::Index n_null() const { return n_free; }

    /// The pseudo-inverse itself.
    Matrix matrix() const
    {
      return spectrum.eigenvectors() * inverted.asDiagonal() * spectrum.eigenvectors().transpose();
    }

    /// The pseudo-inverse times a vector.
    Vector solve(const Vector &right_hand_side) const
    {
      Vector coordinates = spectrum.eigenvectors().transpose() * right_hand_side;
      for (Eigen::Index k = 0; k < coordinates.size(); ++k)
        coordinates[k] = k < n_free ? 0. : coordinates[k] / spectrum.eigenvalues()[k];
      return spectrum.eigenvectors() * coordinates;
    }

    /// A vector of unit length that the matrix maps to zero, 0 <= k < n_null().
    Vector null_vector(const Eigen::Index k) const { return spectrum.eigenvectors().col(k); }

  private:
    Eigen::SelfAdjointEigenSolver<Matrix> spectrum;
    /// Ascending eigenvalues, inverted; those that count as zero come first.
    Vector       inverted;
    Eigen::Index n_free = 0;
  };

  /// Solves by PseudoInverse for each column of right-hand sides. Compiled once, with sizes known at run
  /// time: the eigenvalues of each size known to the compiler take it half a minute.
  Eigen::MatrixXd solve_by_pseudo_inverse(const Eigen::MatrixXd &matrix,
                                          const Eigen::MatrixXd &right_hand_sides,
                                          const double           tolerance);

  /**
   * Solves the normal equations of a fit, scaled to a unit diagonal, with the change of smallest norm where
   * they depend on each other: by Cholesky's factorisation, and by PseudoInverse where that may hide a
   * singular matrix.
   */
  template <typename Matrix, typename Vector>
  Vector solve_semidefinite(const Matrix &matrix, const Vector &right_hand_side, const double tolerance)
  {
    // The diagonal of the factor bounds the smallest eigenvalue from above.
    const Eigen::LLT<Matrix> cholesky(matrix);
    if (cholesky.info() == Eigen::Success && cholesky.matrixLLT().diagonal().minCoeff() > 1e-3)
      return cholesky.solve(right_hand_side);
    return solve_by_pseudo_inverse(matrix, right_hand_side, tolerance);
  }

  /// The pseudo-inverse of a symmetric tensor whose eigenvalues up to @p smallest count as zero; deal.II
  /// finds them.
  dealii::Tensor<2, 3> pseudo_inverse(const dealii::SymmetricTensor<2, 3> &tensor, const double smallest);

  /// Sets @p root to a matrix R with R A R^T = 1, A symmetric and positive semi-definite. Returns false where
  /// A has eigenvalues up to @p smallest: the rows of R in their directions are zero, the others an
  /// eigenvector each.
  template <int dim>
  bool inverse_root(const Eigen::Matrix<double, dim, dim> &matrix,
                    const double                           smallest,
                    Eigen::Matrix<double, dim, dim>       &root);

  /// What solves rows x = b: x = inverse b + free y with any y. The columns of free are orthonormal.
  struct RowInverse
  {
    Eigen::MatrixXd inverse, free;
  };

  /// Inverts any rows by their singular values, of which those up to @p tolerance times the largest count as
  /// zero.
  RowInverse invert_rows(const Eigen::MatrixXd &rows, const double tolerance);

  /// The x of smallest norm that minimises |equations x - values|, by an orthogonal decomposition.
  Eigen::VectorXd least_squares(const Eigen::MatrixXd &equations, const Eigen::VectorXd &values);

  /**
   * Holds the moments A = sum_k W_k p_k p_k^T of a weighted fit to points with the values p_k of a basis, and
   * solves them by LAPACK's Cholesky factorisation, which tells their condition.
   */
  class MomentMatrix
  {
  public:
    /// @param n_terms of the basis
    explicit MomentMatrix(const unsigned int n_terms);

    void clear() { moments = 0.; }

    void add(const std::vector<double> &basis, const double weight)
    {
      for (unsigned int s = 0; s < basis.size(); ++s)
        for (unsigned int t = 0; t < basis.size(); ++t)
          moments(s, t) += weight * basis[s] * basis[t];
    }

    /// Factorises what was added. Returns the reciprocal of the condition in the row sum norm; 0: there is no
    /// factor.
    double factorise();

    /// Replaces a right-hand side by the solution, after factorise().
    void solve(dealii::Vector<double> &vector) const { moments.solve(vector); }

  private:
    dealii::LAPACKFullMatrix<double> moments;
  };
} // namespace perideal

#endif
