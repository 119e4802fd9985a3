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
    /// Stencils that determine them have 0.25 and more, distorted or not; two layers of distorted cells 0.08
    /// at most, and 0.2 where they lie along an arc of 4 degrees a cell.
    constexpr double tolerance = 0.2;
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

  namespace
  {
    /// The least variance of the centroids of a stencil over the second moment of its cell with which they
    /// tell the slope across: two layers have 3, one layer of cells distorted by .3 has .2, between a crack
    /// and a surface for instance.
    constexpr double least_variance = 0.75;

    /// Takes out of the covariance the directions in which a stencil has one layer of cells.
    template <int dim>
    void drop_across_one_layer(const Eigen::Matrix<double, dim, dim> &size,
                               Eigen::Matrix<double, dim, dim>       &covariance)
    {
      using Matrix = Eigen::Matrix<double, dim, dim>;
      if (Eigen::LLT<Matrix>(covariance - least_variance * size).info() == Eigen::Success)
        return;
      const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> over_size(covariance, size);
      // covariance v = lambda size v, with v.size v = 1.
      for (int k = 0; k < dim; ++k)
        if (const double lambda = over_size.eigenvalues()[k]; lambda < least_variance)
          {
            const Eigen::Matrix<double, dim, 1> image = size * over_size.eigenvectors().col(k);
            covariance -= lambda * image * image.transpose();
          }
    }
  } // namespace

  template <int dim>
  void QuadraticFit<dim>::find_metric(const std::vector<Cell>               &others,
                                      const dealii::SymmetricTensor<2, dim> &size)
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
    Metric covariance = sum - mean * mean.transpose();
    drop_across_one_layer(to_eigen(size), covariance);
    // Aspect ratios up to 1e5 count as solid.
    solid = inverse_root<dim>(covariance, 1e-10 * covariance.trace(), metric);
  }

  template <int dim>
  void QuadraticFit<dim>::fill_rows(const dealii::SymmetricTensor<2, dim> &own,
                                    const std::vector<Cell>               &others,
                                    const double                           decay)
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
        weight[k] = std::sqrt(others[k].share) * std::exp(-0.5 * decay * y.squaredNorm()); // the root
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
            dropped.resize(n_quadratic, 0);
            return inverse;
          }
      }
    const Eigen::SelfAdjointEigenSolver<Quadratic> spectrum(gram);
    Quadratic                                      result = Quadratic::Zero();
    n_kept                                                = 0;
    // Eigenvalues increase.
    for (unsigned int k = 0; k < n_quadratic; ++k)
      if (const double value = spectrum.eigenvalues()[k]; value > smallest)
        {
          result += spectrum.eigenvectors().col(k) * spectrum.eigenvectors().col(k).transpose() / value;
          ++n_kept;
        }
    dropped = spectrum.eigenvectors().leftCols(n_quadratic - n_kept);
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
    const Metric inverse = normal.inverse();
    shift                = inverse * (linear.transpose() * quadratic);
    // Gram matrix of what linear terms leave of the quadratics.
    Quadratic    gram = quadratic.transpose() * quadratic;
    const double size = std::sqrt(gram.trace());
    gram -= (linear.transpose() * quadratic).transpose() * shift;
    const Quadratic inverse_gram = inverse_of(gram, size);

    result.resize(rows_of_means.rows());
    for (Eigen::Index k = 0; k < rows_of_means.rows(); ++k)
      {
        const LinearTerms    l = linear.row(k).transpose();
        const QuadraticTerms q = inverse_gram * (quadratic.row(k).transpose() - shift.transpose() * l);
        result[k]              = terms_of_x(inverse * l - shift * q, q);
        for (double &term : result[k])
          term *= weight[k];
      }
  }

  template <int dim>
  typename QuadraticFit<dim>::Terms QuadraticFit<dim>::terms_of_x(const LinearTerms    &linear,
                                                                  const QuadraticTerms &quadratic) const
  {
    // Coefficients of the images y to those of x: c = metric^T c_y, Hessian metric^T H_y metric.
    const LinearTerms of_x = metric.transpose() * linear;
    Metric            hessian;
    for (unsigned int p = 0; p < n_quadratic; ++p)
      {
        const auto [a, b] = SymmetricPairs<dim>::axes(p);
        hessian(a, b) = hessian(b, a) = (a == b ? 2. : root_2) * quadratic[p];
      }
    hessian = metric.transpose() * hessian * metric;
    Terms terms;
    for (int d = 0; d < dim; ++d)
      terms[d] = of_x[d];
    for (unsigned int p = 0; p < n_quadratic; ++p)
      {
        const auto [a, b] = SymmetricPairs<dim>::axes(p);
        terms[dim + p]    = (a == b ? 0.5 : 1.) * hessian(a, b);
      }
    return terms;
  }

  template <int dim>
  std::vector<typename QuadraticFit<dim>::Terms> QuadraticFit<dim>::undetermined() const
  {
    std::vector<Terms> polynomials;
    for (Eigen::Index k = 0; k < dropped.cols(); ++k)
      polynomials.push_back(terms_of_x(-shift * dropped.col(k), dropped.col(k)));
    return polynomials;
  }

  template <int dim>
  typename QuadraticFit<dim>::Quadratic
  QuadraticFit<dim>::squares_of(const std::vector<dealii::Tensor<1, dim>> &surfaces) const
  {
    // Normals transform as gradients do.
    const Metric    of_normals = metric.inverse().transpose();
    const Quadratic projection = dropped * dropped.transpose();
    Quadratic       sum        = Quadratic::Zero();
    for (const auto &surface : surfaces)
      {
        const LinearTerms normal = (of_normals * to_eigen(surface)).normalized();
        QuadraticTerms    square;
        for (unsigned int p = 0; p < n_quadratic; ++p)
          square[p] = (p < dim ? 1. : root_2) * normal[SymmetricPairs<dim>::axes(p).first] *
                      normal[SymmetricPairs<dim>::axes(p).second];
        if (square.dot(projection * square) > 0.5)
          sum += square * square.transpose() / surfaces.size();
      }
    return sum;
  }

  template <int dim>
  bool QuadraticFit<dim>::misses_only_across(const std::vector<dealii::Tensor<1, dim>> &surfaces) const
  {
    const Eigen::MatrixXd shares = dropped.transpose() * squares_of(surfaces) * dropped;
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(shares).eigenvalues().minCoeff() >
           0.2 / surfaces.size();
  }

  template <int dim>
  std::vector<typename QuadraticFit<dim>::Terms>
  QuadraticFit<dim>::squares_across(const std::vector<dealii::Tensor<1, dim>> &surfaces) const
  {
    const Quadratic sum =
      misses_only_across(surfaces) ? squares_of(surfaces) : Quadratic(dropped * dropped.transpose());
    const Eigen::SelfAdjointEigenSolver<Quadratic> spectrum(sum);
    std::vector<Terms>                             squares;
    for (Eigen::Index k = 0; k < dropped.cols(); ++k)
      squares.push_back(terms_of_x(LinearTerms::Zero(), spectrum.eigenvectors().col(n_quadratic - 1 - k)));
    return squares;
  }

  template <int dim>
  void QuadraticFit<dim>::reinit(const dealii::SymmetricTensor<2, dim> &own,
                                 const std::vector<Cell>               &others,
                                 const dealii::SymmetricTensor<2, dim> &size,
                                 const double                           decay)
  {
    find_metric(others, size);
    fill_rows(own, others, decay);
    solve();
  }

  PERIDEAL_INSTANTIATE_CLASS(QuadraticFit)
} // namespace perideal
