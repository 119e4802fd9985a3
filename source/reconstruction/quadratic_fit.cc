// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/reconstruction/quadratic_fit.h>

#include <cmath>

namespace perideal
{
  namespace
  {
    /// Directions of quadratics whose singular value is below this part of the mean one are left out.
    /// Stencils that determine them have 0.27 and more, distorted or not; two layers of distorted cells 0.08
    /// at most.
    constexpr double tolerance = 0.15;
    /// Scales mixed quadratics, so that what is determined does not depend on the axes.
    const double root_2 = std::sqrt(2.);

    template <int dim>
    Eigen::Matrix<double, dim, dim> to_eigen(const dealii::SymmetricTensor<2, dim> &tensor)
    {
      Eigen::Matrix<double, dim, dim> result;
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          result(a, b) = tensor[a][b];
      return result;
    }

    template <int dim>
    Eigen::Matrix<double, dim, 1> to_eigen(const dealii::Tensor<1, dim> &tensor)
    {
      Eigen::Matrix<double, dim, 1> result;
      for (int a = 0; a < dim; ++a)
        result[a] = tensor[a];
      return result;
    }
  } // namespace

  template <int dim>
  void QuadraticFit<dim>::find_metric(const std::vector<Cell> &others)
  {
    const double                  n    = others.size() + 1.;
    Eigen::Matrix<double, dim, 1> mean = Eigen::Matrix<double, dim, 1>::Zero();
    Metric                        sum  = Metric::Zero();
    for (const Cell &cell : others)
      {
        const auto x = to_eigen(cell.distance);
        mean += x / n;
        sum += x * x.transpose() / n;
      }
    const Metric covariance = sum - mean * mean.transpose();
    // Aspect ratios up to 1e5 count as solid.
    solid = inverse_root<dim>(covariance, 1e-10 * covariance.trace(), metric);
  }

  template <int dim>
  void QuadraticFit<dim>::fill_rows(const dealii::SymmetricTensor<2, dim> &own,
                                    const std::vector<Cell>               &others)
  {
    const auto means_about = [&](const Eigen::Matrix<double, dim, 1>   &y,
                                 const dealii::SymmetricTensor<2, dim> &second_moment,
                                 std::array<double, n_terms>           &means) {
      const Metric square = y * y.transpose() + metric * to_eigen(second_moment) * metric.transpose();
      for (int d = 0; d < dim; ++d)
        means[d] = y[d];
      for (unsigned int p = 0; p < n_quadratic; ++p)
        means[dim + p] = (p < dim ? 1. : root_2) *
                         square(SymmetricPairs<dim>::axes(p).first, SymmetricPairs<dim>::axes(p).second);
    };
    std::array<double, n_terms> at_middle, means;
    means_about(Eigen::Matrix<double, dim, 1>::Zero(), own, at_middle);
    rows_of_means.resize(others.size(), n_terms);
    weight.resize(others.size());
    for (std::size_t k = 0; k < others.size(); ++k)
      {
        const Eigen::Matrix<double, dim, 1> y = metric * to_eigen(others[k].distance);
        means_about(y, others[k].second_moment, means);
        weight[k] = std::exp(-0.25 * y.squaredNorm()); // the root of the weight
        for (unsigned int t = 0; t < n_terms; ++t)
          rows_of_means(k, t) = weight[k] * (means[t] - at_middle[t]);
      }
  }

  template <int dim>
  typename QuadraticFit<dim>::Quadratic QuadraticFit<dim>::inverse_of(const Quadratic &gram,
                                                                      const double     size)
  {
    const double                smallest = tolerance * tolerance * size * size / n_quadratic;
    const Eigen::LLT<Quadratic> cholesky(gram);
    if (cholesky.info() == Eigen::Success)
      {
        const Quadratic inverse = cholesky.solve(Quadratic::Identity());
        // No eigenvalue of the inverse exceeds its norm.
        if (inverse.norm() * smallest < 1.)
          {
            n_kept = n_quadratic;
            return inverse;
          }
      }
    const Eigen::SelfAdjointEigenSolver<Quadratic> spectrum(gram);
    Quadratic                                      result = Quadratic::Zero();
    n_kept                                                = 0;
    for (unsigned int k = 0; k < n_quadratic; ++k)
      if (const double value = spectrum.eigenvalues()[k]; value > smallest)
        {
          result += spectrum.eigenvectors().col(k) * spectrum.eigenvectors().col(k).transpose() / value;
          ++n_kept;
        }
    return result;
  }

  template <int dim>
  void QuadraticFit<dim>::solve()
  {
    const auto linear    = rows_of_means.template leftCols<dim>();
    const auto quadratic = rows_of_means.template rightCols<n_quadratic>();
    // Where the stencil is plane, rows and columns of what lies across it are zero.
    Metric normal = linear.transpose() * linear;
    for (int d = 0; d < dim; ++d)
      if (normal(d, d) == 0.)
        normal(d, d) = 1.;
    const Metric                                  inverse = normal.inverse();
    const Eigen::Matrix<double, dim, n_quadratic> shift   = inverse * (linear.transpose() * quadratic);
    // Gram matrix of what linear terms leave of the quadratics.
    Quadratic    gram = quadratic.transpose() * quadratic;
    const double size = std::sqrt(gram.trace());
    gram -= (linear.transpose() * quadratic).transpose() * shift;
    const Quadratic inverse_gram = inverse_of(gram, size);

    // Coefficients of the images y to those of x: c = metric^T c_y, Hessian metric^T H_y metric.
    result.resize(rows_of_means.rows());
    for (Eigen::Index k = 0; k < rows_of_means.rows(); ++k)
      {
        const Eigen::Matrix<double, dim, 1>         l = linear.row(k).transpose();
        const Eigen::Matrix<double, n_quadratic, 1> q =
          inverse_gram * (quadratic.row(k).transpose() - shift.transpose() * l);
        const Eigen::Matrix<double, dim, 1> of_x = metric.transpose() * (inverse * l - shift * q);
        Metric                              hessian;
        for (unsigned int p = 0; p < n_quadratic; ++p)
          {
            const auto [a, b] = SymmetricPairs<dim>::axes(p);
            hessian(a, b) = hessian(b, a) = (a == b ? 2. : root_2) * q[p];
          }
        hessian = metric.transpose() * hessian * metric;
        for (int d = 0; d < dim; ++d)
          result[k][d] = weight[k] * of_x[d];
        for (unsigned int p = 0; p < n_quadratic; ++p)
          {
            const auto [a, b]  = SymmetricPairs<dim>::axes(p);
            result[k][dim + p] = weight[k] * (a == b ? 0.5 : 1.) * hessian(a, b);
          }
      }
  }

  template <int dim>
  void QuadraticFit<dim>::reinit(const dealii::SymmetricTensor<2, dim> &own, const std::vector<Cell> &others)
  {
    find_metric(others);
    fill_rows(own, others);
    solve();
  }

  PERIDEAL_INSTANTIATE_CLASS(QuadraticFit)
} // namespace perideal
