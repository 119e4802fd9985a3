// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_quadratic_terms_h
#define perideal_reconstruction_quadratic_terms_h

#include <deal.II/base/tensor.h>

#include <Eigen/Core>

namespace perideal
{
  /// Coefficients of a quadratic polynomial without its constant, or what they are multiplied with.
  template <int dim>
  using QuadraticTerms = Eigen::Matrix<double, dim + dim *(dim + 1) / 2, 1>;

  /// d, and the products of its components.
  template <int dim>
  QuadraticTerms<dim> quadratic_terms(const dealii::Tensor<1, dim> &d)
  {
    QuadraticTerms<dim> result;
    unsigned int        k = dim;
    for (int a = 0; a < dim; ++a)
      {
        result[a] = d[a];
        for (int b = a; b < dim; ++b)
          result[k++] = d[a] * d[b];
      }
    return result;
  }
} // namespace perideal

#endif
