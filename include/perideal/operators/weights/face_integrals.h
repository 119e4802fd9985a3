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

  /**
   * A rectangular face across an axis a, whose centre lies on the lines through the centroids of both cells
   * along that axis, as in grids along the axes. Most moments vanish, and a polynomial needs to be known
   * there as
   *
   *     value + sum_j slope_j t_j + square_j t_j^2,   t_j along the other axes.
   */
  template <int dim>
  struct AlignedFace
  {
    static constexpr unsigned int none = dim;

    /// The axis; none where the face is not such.
    unsigned int axis = none;
    /// Moments of 1 and of the squares t_j^2, times the normal [m^(dim-1)], [m^(dim+1)].
    double area = 0, square[dim - 1] = {};
    /// Of the centre from the two centroids along the axis [m].
    double offset[2] = {};
  };

  /// Values along an aligned face, or what acts on them, lanes by component.
  template <int dim>
  struct AlignedPolynomial
  {
    Lanes value = {}, slope[dim - 1] = {}, square[dim - 1] = {};
  };

  /// Adds share times a polynomial about a centroid.
  template <int dim, unsigned int axis>
  PERIDEAL_INLINE void
  add_along(const NodeRecord *from, const double offset, const double share, AlignedPolynomial<dim> &result)
  {
    result.value +=
      share * (lanes(from[0]) + offset * (lanes(from[1 + axis]) + offset * lanes(from[1 + dim + axis])));
    for (unsigned int j = 0; j < dim - 1; ++j)
      {
        const unsigned int other = (axis + 1 + j) % dim;
        const unsigned int mixed = SymmetricPairs<dim>::number_of(axis, other);
        result.slope[j] += share * (lanes(from[1 + other]) + offset * lanes(from[1 + dim + mixed]));
        result.square[j] += share * lanes(from[1 + dim + other]);
      }
  }

  /// The transpose of add_along().
  template <int dim, unsigned int axis>
  PERIDEAL_INLINE void add_along_back(const AlignedPolynomial<dim> &from,
                                      const double                  offset,
                                      const double                  share,
                                      NodeRecord                   *result)
  {
    const Lanes value = share * from.value;
    lanes(result[0]) += value;
    lanes(result[1 + axis]) += offset * value;
    lanes(result[1 + dim + axis]) += (offset * offset) * value;
    for (unsigned int j = 0; j < dim - 1; ++j)
      {
        const unsigned int other = (axis + 1 + j) % dim;
        const unsigned int mixed = SymmetricPairs<dim>::number_of(axis, other);
        const Lanes        slope = share * from.slope[j];
        lanes(result[1 + other]) += slope;
        lanes(result[1 + dim + mixed]) += offset * slope;
        lanes(result[1 + dim + other]) += share * from.square[j];
      }
  }
} // namespace perideal

#endif
