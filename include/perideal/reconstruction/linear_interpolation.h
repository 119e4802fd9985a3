// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_linear_interpolation_h
#define perideal_reconstruction_linear_interpolation_h

#include <deal.II/base/point.h>

#include <Eigen/Dense>

#include <vector>

namespace perideal
{
  /**
   * Fits moving least squares of order one: finds the weights phi_k with which the values at
   * scattered points give the value of their best linear fit at points around a
   * centre,
   *
   *     v(x) = sum_k phi_k(x) v_k,    sum_k phi_k = 1,  sum_k phi_k x_k = x.
   *
   * Distances are measured with the inverse covariance of the points, so that
   * stretched and sheared cells weigh as their undeformed images would.
   */
  template <int dim>
  class LinearInterpolation
  {
  public:
    /// How the weight of a point falls with its squared distance from the centre.
    enum class Decay
    {
      /// exp(-r^2), for centres between the points.
      between,
      /// 1/(1+r^2), for centres at the rim of the points: the far ones carry the slope.
      at_rim
    };

    /**
     * Fits to @p points. @p favoured ones (numbers in points) weigh ten times as much.
     * Returns false when the points lie in a plane (a line), where a linear fit
     * does not exist: the value is then constant across it.
     */
    bool reinit(const dealii::Point<dim>              &centre,
                const std::vector<dealii::Point<dim>> &points,
                const Decay                            decay,
                const std::vector<unsigned int>       &favoured);

    /// The weights phi at @p point, by points of reinit().
    const std::vector<double> &weights_at(const dealii::Point<dim> &point);

  private:
    using Metric = Eigen::Matrix<double, dim, dim>;
    using Vector = Eigen::Matrix<double, dim, 1>;

    bool find_metric(const std::vector<dealii::Point<dim>> &points);

    dealii::Point<dim> centre;
    /// Maps distances to the undeformed image; singular where the points are plane.
    Metric                                               metric;
    std::vector<Vector>                                  image;
    std::vector<double>                                  weight, result;
    Eigen::LDLT<Eigen::Matrix<double, dim + 1, dim + 1>> moments;
  };
} // namespace perideal

#endif
