// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_face_integrals_h
#define perideal_operators_weights_face_integrals_h

#include <perideal/base/lanes.h>
#include <perideal/reconstruction/monomials.h>

// Integrals of quadratic polynomials over faces by their moments (FaceMoments), lanes by component, and the
// transposes: what acts on the integrals as forces on coefficients.

namespace perideal
{
  /// Adds share times a polynomial about a centroid, in coefficients about a point that is offset from there.
  template <int dim>
  PERIDEAL_INLINE void
  add_shifted(const NodeRecord *from, const double *offset, const double share, Lanes *result)
  {
    using M   = Monomials<dim>;
    Lanes sum = lanes(from[0]), slope[dim];
    for (unsigned int d = 0; d < dim; ++d)
      {
        slope[d] = lanes(from[1 + d]);
        sum += offset[d] * slope[d];
      }
    for (unsigned int p = 0; p < M::n_quadratic; ++p)
      {
        constexpr auto axes = SymmetricPairs<dim>::axes;
        const auto [a, b]   = axes(p);
        const Lanes q       = lanes(from[1 + dim + p]);
        sum += (offset[a] * offset[b]) * q;
        slope[a] += offset[b] * q;
        slope[b] += offset[a] * q;
        result[1 + dim + p] += share * q;
      }
    result[0] += share * sum;
    for (unsigned int d = 0; d < dim; ++d)
      result[1 + d] += share * slope[d];
  }

  /// The transpose of add_shifted().
  template <int dim>
  PERIDEAL_INLINE void
  add_shifted_back(const Lanes *from, const double *offset, const double share, NodeRecord *result)
  {
    using M = Monomials<dim>;
    Lanes scaled[1 + dim];
    for (unsigned int m = 0; m < 1 + dim; ++m)
      scaled[m] = share * from[m];
    lanes(result[0]) += scaled[0];
    for (unsigned int d = 0; d < dim; ++d)
      lanes(result[1 + d]) += scaled[1 + d] + offset[d] * scaled[0];
    for (unsigned int p = 0; p < M::n_quadratic; ++p)
      {
        const auto [a, b] = SymmetricPairs<dim>::axes(p);
        lanes(result[1 + dim + p]) += share * from[1 + dim + p] + (offset[a] * offset[b]) * scaled[0] +
                                      offset[b] * scaled[1 + a] + offset[a] * scaled[1 + b];
      }
  }

  /// What a face adds to V G_l and to H_kl about its centre.
  template <int dim>
  struct FaceSums
  {
    Lanes gradient[dim], moment[dim][dim];
  };

  /// Integrates a polynomial over a face.
  template <int dim>
  PERIDEAL_INLINE void
  integrate(const double *moments, const bool is_plane, const Lanes *polynomial, FaceSums<dim> &sums)
  {
    using M = Monomials<dim>;
    if (is_plane)
      {
        const double *t     = moments + dim;
        Lanes         value = {}, first[dim] = {};
        for (unsigned int m = 0; m < M::n_coefficients; ++m)
          {
            value += t[m] * polynomial[m];
            for (unsigned int k = 0; k < dim; ++k)
              first[k] += t[M::times(m, k)] * polynomial[m];
          }
        for (unsigned int l = 0; l < dim; ++l)
          {
            sums.gradient[l] = moments[l] * value;
            for (unsigned int k = 0; k < dim; ++k)
              sums.moment[k][l] = moments[l] * first[k];
          }
      }
    else
      for (unsigned int l = 0; l < dim; ++l)
        {
          const double *t     = moments + l * M::n;
          Lanes         value = {}, first[dim] = {};
          for (unsigned int m = 0; m < M::n_coefficients; ++m)
            {
              value += t[m] * polynomial[m];
              for (unsigned int k = 0; k < dim; ++k)
                first[k] += t[M::times(m, k)] * polynomial[m];
            }
          sums.gradient[l] = value;
          for (unsigned int k = 0; k < dim; ++k)
            sums.moment[k][l] = first[k];
        }
  }

  /// The transpose of integrate().
  template <int dim>
  PERIDEAL_INLINE void
  integrate_back(const double *moments, const bool is_plane, const FaceSums<dim> &sums, Lanes *polynomial)
  {
    using M = Monomials<dim>;
    if (is_plane)
      {
        const double *t     = moments + dim;
        Lanes         value = {}, first[dim] = {};
        for (unsigned int l = 0; l < dim; ++l)
          {
            value += moments[l] * sums.gradient[l];
            for (unsigned int k = 0; k < dim; ++k)
              first[k] += moments[l] * sums.moment[k][l];
          }
        for (unsigned int m = 0; m < M::n_coefficients; ++m)
          {
            Lanes sum = t[m] * value;
            for (unsigned int k = 0; k < dim; ++k)
              sum += t[M::times(m, k)] * first[k];
            polynomial[m] = sum;
          }
      }
    else
      for (unsigned int m = 0; m < M::n_coefficients; ++m)
        {
          Lanes sum = {};
          for (unsigned int l = 0; l < dim; ++l)
            {
              const double *t = moments + l * M::n;
              sum += t[m] * sums.gradient[l];
              for (unsigned int k = 0; k < dim; ++k)
                sum += t[M::times(m, k)] * sums.moment[k][l];
            }
          polynomial[m] = sum;
        }
  }
} // namespace perideal

#endif
