// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/reconstruction/linear_interpolation.h>

#include <cmath>

namespace perideal
{
  template <int dim>
  bool LinearInterpolation<dim>::find_metric(const std::vector<dealii::Point<dim>> &points)
  {
    dealii::Tensor<1, dim> mean;
    for (const auto &point : points)
      mean += point / static_cast<double>(points.size());
    Metric covariance = Metric::Zero();
    for (const auto &point : points)
      {
        Vector distance;
        for (int d = 0; d < dim; ++d)
          distance[d] = point[d] - mean[d];
        covariance += distance * distance.transpose() / points.size();
      }
    // Aspect ratios up to 1e5 count as solid.
    return inverse_root<dim>(covariance, 1e-10 * covariance.trace(), metric);
  }

  template <int dim>
  bool LinearInterpolation<dim>::reinit(const dealii::Point<dim>              &centre,
                                        const std::vector<dealii::Point<dim>> &points,
                                        const Decay                            decay,
                                        const std::vector<unsigned int>       &favoured)
  {
    this->centre        = centre;
    const bool is_solid = find_metric(points);
    image.resize(points.size());
    weight.resize(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
      {
        Vector distance;
        for (int d = 0; d < dim; ++d)
          distance[d] = points[k][d] - centre[d];
        image[k]        = metric * distance;
        const double r2 = image[k].squaredNorm();
        weight[k]       = decay == Decay::between ? std::exp(-r2) : 1. / (1. + r2);
      }
    for (const unsigned int k : favoured)
      weight[k] *= 10.;

    Eigen::Matrix<double, dim + 1, dim + 1> sum = Eigen::Matrix<double, dim + 1, dim + 1>::Zero();
    for (std::size_t k = 0; k < points.size(); ++k)
      {
        Eigen::Matrix<double, dim + 1, 1> basis;
        basis << 1., image[k];
        sum.template selfadjointView<Eigen::Lower>().rankUpdate(basis, weight[k]);
      }
    if (!is_solid)
      for (int d = 0; d < dim; ++d)
        if (metric.row(d).isZero(0.))
          sum(d + 1, d + 1) = 1.;
    moments.compute(sum);
    return is_solid;
  }

  template <int dim>
  const std::vector<double> &LinearInterpolation<dim>::weights_at(const dealii::Point<dim> &point)
  {
    Vector distance;
    for (int d = 0; d < dim; ++d)
      distance[d] = point[d] - centre[d];
    Eigen::Matrix<double, dim + 1, 1> basis;
    basis << 1., metric * distance;
    const Eigen::Matrix<double, dim + 1, 1> coefficients = moments.solve(basis);
    result.resize(weight.size());
    for (std::size_t k = 0; k < result.size(); ++k)
      result[k] = weight[k] * (coefficients[0] + coefficients.template tail<dim>().dot(image[k]));
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(LinearInterpolation)
} // namespace perideal
