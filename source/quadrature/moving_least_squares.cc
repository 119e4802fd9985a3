// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/quadrature/moving_least_squares.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace perideal
{
  template <int dim>
  MovingLeastSquares<dim>::MovingLeastSquares()
    : moments(n_terms)
    , solution(n_terms)
    , basis(n_terms)
  {
  }

  template <int dim>
  void MovingLeastSquares<dim>::evaluate_basis(const dealii::Tensor<1, dim> &distance,
                                               std::vector<double>          &basis)
  {
    unsigned int t = 0;
    basis[t++]     = 1.;
    for (int d = 0; d < dim; ++d)
      basis[t++] = distance[d];
    for (int d = 0; d < dim; ++d)
      for (int e = d; e < dim; ++e)
        basis[t++] = distance[d] * distance[e];
  }

  template <int dim>
  double MovingLeastSquares<dim>::consistency_error() const
  {
    double error = 0;
    for (unsigned int t = 0; t < n_terms; ++t)
      {
        double value = 0;
        for (std::size_t m = 0; m < member.size(); ++m)
          value += phi[member[m]] * basis_of_member[n_terms * m + t];
        error = std::max(error, std::abs(value - (t == 0 ? 1. : 0.)));
      }
    return error;
  }

  template <int dim>
  bool MovingLeastSquares<dim>::reinit(const dealii::Point<dim>              &x,
                                       const std::vector<dealii::Point<dim>> &points,
                                       const double                           radius)
  {
    reason.clear();
    phi.assign(points.size(), 0.);
    member.clear();
    weight.clear();
    basis_of_member.clear();
    moments.clear();
    for (std::size_t k = 0; k < points.size(); ++k)
      {
        const dealii::Tensor<1, dim> distance = (points[k] - x) / radius;
        const double                 d2       = distance.norm_square();
        if (d2 >= 1.)
          continue;
        const double d = std::sqrt(d2);
        member.push_back(static_cast<unsigned int>(k));
        weight.push_back(1. - d2 * (6. - d * (8. - 3. * d)));
        evaluate_basis(distance, basis);
        basis_of_member.insert(basis_of_member.end(), basis.begin(), basis.end());
        moments.add(basis, weight.back());
      }
    if (member.size() < n_terms)
      {
        reason = std::to_string(member.size()) + " points within the radius, where " +
                 std::to_string(n_terms) + " or more are needed";
        return false;
      }

    const double reciprocal_condition = moments.factorise();
    if (!(reciprocal_condition * largest_condition >= 1.))
      {
        std::ostringstream text;
        text << "the points within the radius are not in general position (condition of their moments "
             << 1. / reciprocal_condition << ")";
        reason = text.str();
        return false;
      }
    // p(x) about x itself is the first unit vector.
    solution    = 0.;
    solution(0) = 1.;
    moments.solve(solution);
    for (std::size_t m = 0; m < member.size(); ++m)
      {
        double value = 0;
        for (unsigned int t = 0; t < n_terms; ++t)
          value += basis_of_member[n_terms * m + t] * solution(t);
        phi[member[m]] = weight[m] * value;
      }
    if (const double error = consistency_error(); !(error <= consistency_tolerance))
      {
        reason = "quadratic fields are missed by " + std::to_string(error);
        return false;
      }
    return true;
  }

  PERIDEAL_INSTANTIATE_CLASS(MovingLeastSquares)
} // namespace perideal
