// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_point_lanes_h
#define perideal_operators_weights_point_lanes_h

#include <perideal/base/lanes.h>
#include <perideal/base/symmetric_pairs.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>

// Stress of laws whose modulus dS/dE is the same at every strain, of a point or of the points of a cell at
// once: numbers are doubles or lanes.

namespace perideal
{
  /// A displacement gradient du_a/dx_l [-], F = I + that, or a first Piola-Kirchhoff stress [Pa]: entry (a,
  /// l).
  template <int dim, typename Number>
  struct PointTensor
  {
    Number entry[dim][dim] = {};
  };

  /// A strain (xx, yy, .., 2xy, ..) or a stress (xx, yy, .., xy, ..), see symmetric_pairs.h.
  template <int dim, typename Number>
  struct PointPairs
  {
    Number pair[SymmetricPairs<dim>::n_pairs] = {};
  };

  /// Green's strain of a displacement gradient.
  template <int dim, typename Number>
  PERIDEAL_INLINE PointPairs<dim, Number> green_strain(const PointTensor<dim, Number> &gradient)
  {
    PointPairs<dim, Number> result;
    const auto             &G = gradient.entry;
    for (unsigned int p = 0; p < SymmetricPairs<dim>::n_pairs; ++p)
      {
        const auto [a, b] = SymmetricPairs<dim>::axes(p);
        Number product    = G[0][a] * G[0][b];
        for (unsigned int k = 1; k < dim; ++k)
          product += G[k][a] * G[k][b];
        result.pair[p] = a == b ? G[a][a] + 0.5 * product : G[a][b] + G[b][a] + product;
      }
    return result;
  }

  /// Its change, sym(F^T dG).
  template <int dim, typename Number>
  PERIDEAL_INLINE PointPairs<dim, Number> change_of_strain(const PointTensor<dim, Number> &deformation,
                                                           const PointTensor<dim, Number> &change)
  {
    PointPairs<dim, Number> result;
    const auto             &F = deformation.entry, &G = change.entry;
    for (unsigned int p = 0; p < SymmetricPairs<dim>::n_pairs; ++p)
      {
        const auto [a, b] = SymmetricPairs<dim>::axes(p);
        for (unsigned int k = 0; k < dim; ++k)
          {
            result.pair[p] += F[k][a] * G[k][b];
            if (a != b)
              result.pair[p] += F[k][b] * G[k][a];
          }
      }
    return result;
  }

  /// Adds the product of a tensor with a symmetric stress.
  template <int dim, typename Number>
  PERIDEAL_INLINE void add_product(const PointTensor<dim, Number> &tensor,
                                   const PointPairs<dim, Number>  &stress,
                                   PointTensor<dim, Number>       &result)
  {
    for (unsigned int p = 0; p < SymmetricPairs<dim>::n_pairs; ++p)
      {
        const auto [a, b] = SymmetricPairs<dim>::axes(p);
        for (unsigned int k = 0; k < dim; ++k)
          {
            result.entry[k][b] += tensor.entry[k][a] * stress.pair[p];
            if (a != b)
              result.entry[k][a] += tensor.entry[k][b] * stress.pair[p];
          }
      }
  }

  /// dS/dE of the second Piola-Kirchhoff stress with Green's strain, as a symmetric matrix on pairs.
  template <int dim>
  class PointModulus
  {
  public:
    /// @param modulus [Pa]
    explicit PointModulus(const dealii::SymmetricTensor<4, dim> &modulus)
    {
      auto next = lower.begin();
      for (unsigned int r = 0; r < n_pairs; ++r)
        for (unsigned int c = 0; c <= r; ++c, ++next)
          {
            const auto [a, b] = SymmetricPairs<dim>::axes(r);
            const auto [k, l] = SymmetricPairs<dim>::axes(c);
            *next             = modulus[a][b][k][l];
            couples           = couples || (r >= dim && c < r && *next != 0.);
          }
    }

    /// The stress of a strain [Pa].
    template <typename Number>
    PERIDEAL_INLINE PointPairs<dim, Number> stress(const PointPairs<dim, Number> &strain) const
    {
      PointPairs<dim, Number> result;
      const double           *entry = lower.data();
      for (unsigned int r = 0; r < n_pairs; entry += ++r)
        {
          for (unsigned int c = 0; c < r; ++c)
            if (r < dim || couples)
              {
                result.pair[r] += entry[c] * strain.pair[c];
                result.pair[c] += entry[c] * strain.pair[r];
              }
          result.pair[r] += entry[r] * strain.pair[r];
        }
      return result;
    }

  private:
    static constexpr unsigned int n_pairs = SymmetricPairs<dim>::n_pairs;

    /// The lower triangle by rows [Pa].
    std::array<double, n_pairs *(n_pairs + 1) / 2> lower;
    /// Whether shear strains make other stresses than their own.
    bool couples = false;
  };

  /**
   * The points of a cell (CellPoints), lanes by the axis they lie along, on the two sides of the centroid.
   */
  template <int dim>
  class PointLanes
  {
  public:
    using Tensor = PointTensor<dim, Lanes>;

    /// @param q of CellPoints [1/m^4]
    explicit PointLanes(const dealii::SymmetricTensor<2, dim> &q)
    {
      for (unsigned int m = 0; m < dim; ++m)
        for (unsigned int k = 0; k < dim; ++k)
          along[m][k] = offset[k][m] = q[k][m];
    }

    /// By what a number of first moments moment(m) is above its mean at the points on the positive side.
    template <typename Moment>
    PERIDEAL_INLINE Lanes above_mean(const Moment &moment) const
    {
      Lanes result = moment(0) * along[0];
      for (unsigned int m = 1; m < dim; ++m)
        result += moment(m) * along[m];
      return result;
    }

    /// Makes the tensors at the points of the mean mean(a, l) in the cell and change(a, l), what is above it.
    template <typename Mean, typename Change>
    static PERIDEAL_INLINE void
    combine(const Mean &mean, const Change &change, Tensor &positive, Tensor &negative)
    {
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int l = 0; l < dim; ++l)
          {
            const Lanes difference = change(a, l);
            positive.entry[a][l]   = mean(a, l) + difference;
            negative.entry[a][l]   = mean(a, l) - difference;
          }
    }

    /// Makes the gradients at the points of the gradient of a cell and its moment, columns with lanes by
    /// component.
    PERIDEAL_INLINE void
    at_points(const NodeRecord *gradient, const NodeRecord *moment, Tensor &positive, Tensor &negative) const
    {
      combine([&](const unsigned int a, const unsigned int l) { return gradient[l].value[a]; },
              [&](const unsigned int a, const unsigned int l) {
                return above_mean([&](const unsigned int m) { return moment[dim * m + l].value[a]; });
              },
              positive,
              negative);
    }

    /// Writes what acts on the gradient of the cell and its moments, lanes by component, of stresses at the
    /// points: weight is the volume of a point as far as it counts [m^3].
    PERIDEAL_INLINE void sum(const Tensor &positive,
                             const Tensor &negative,
                             const double  weight,
                             NodeRecord   *on_gradient,
                             NodeRecord   *on_moment) const
    {
      for (unsigned int l = 0; l < dim; ++l)
        {
          Lanes of_entry[4] = {}, both[4], difference[4];
          for (unsigned int a = 0; a < dim; ++a)
            of_entry[a] = weight * (positive.entry[a][l] + negative.entry[a][l]);
          transpose(of_entry, both);
          for (unsigned int a = 0; a < dim; ++a)
            of_entry[a] = weight * (positive.entry[a][l] - negative.entry[a][l]);
          transpose(of_entry, difference);
          Lanes total = both[0];
          for (unsigned int k = 1; k < dim; ++k)
            total += both[k];
          lanes(on_gradient[l]) = total;
          for (unsigned int m = 0; m < dim; ++m)
            {
              Lanes of_moment = offset[0][m] * difference[0];
              for (unsigned int k = 1; k < dim; ++k)
                of_moment += offset[k][m] * difference[k];
              lanes(on_moment[dim * m + l]) = of_moment;
            }
        }
    }

  private:
    Lanes  along[dim] = {};
    double offset[dim][dim];
  };
} // namespace perideal

#endif
