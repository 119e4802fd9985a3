// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_cell_points_h
#define perideal_operators_weights_cell_points_h

#include <perideal/base/symmetric_pairs.h>
#include <perideal/operators/weights/cell_shares.h>
#include <perideal/operators/weights/gradient_moments.h>
#include <perideal/operators/weights/point_lanes.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace perideal
{
  /// The tensor of the columns t_l, lanes by row.
  template <int dim>
  dealii::Tensor<2, dim> to_tensor(const NodeRecord *t)
  {
    dealii::Tensor<2, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int l = 0; l < dim; ++l)
        result[a][l] = t[l].value[a];
    return result;
  }

  /// Adds a tensor to such columns.
  template <int dim>
  void add_columns(const dealii::Tensor<2, dim> &tensor, NodeRecord *t)
  {
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int l = 0; l < dim; ++l)
        t[l].value[a] += tensor[a][l];
  }

  /**
   * Looks at the gradient of a cell at 2 dim points of equal weight, on both sides of the centroid, such that
   * their second moments are those of the cell. With the gradient linear in a cell, of mean G and first
   * moment H (GradientMoments), it is
   *
   *     G(+-k) = G +- sum_m q_km H_m,   q = (dim/V)^1/2 M^-1/2,   M = int (x - x_i) (x) (x - x_i)
   *
   * there, and the mean energy of a linear law over the points is exactly that over the cell, mean and
   * variance; any other law is integrated to third order.
   */
  template <int dim>
  class CellPoints
  {
  public:
    static constexpr unsigned int n = 2 * dim;

    /// @param shares by which the energy of cells counts
    CellPoints(const CellPolynomials<dim> &polynomials, const std::shared_ptr<const CellShares> &shares)
      : volume(polynomials.volumes())
      , shares(shares)
    {
      for (LocalIndex i = 0; i < volume.size(); ++i)
        {
          dealii::SymmetricTensor<2, dim> root;
          for (const auto &[value, axis] : dealii::eigenvectors(
                 polynomials.second_moments()[i], dealii::SymmetricTensorEigenvectorMethod::jacobi))
            root += std::sqrt(dim / value) / volume[i] * dealii::symmetrize(outer_product(axis, axis));
          offset.emplace_back();
          for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
            offset[i][p] = root[Symmetric::axes(p).first][Symmetric::axes(p).second];
        }
    }

    /// Volume of a point as far as it counts [m^3].
    double weight(const LocalIndex i) const { return shares->of(i) * volume[i] / n; }

    /// q of an owned cell [1/m^4].
    dealii::SymmetricTensor<2, dim> offsets(const LocalIndex i) const
    {
      dealii::SymmetricTensor<2, dim> result;
      for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
        result[Symmetric::axes(p).first][Symmetric::axes(p).second] = offset[i][p];
      return result;
    }

    /// With whose product with a first moment what is linear in an owned cell is above its mean at a point.
    dealii::Tensor<1, dim> offset_of(const LocalIndex i, const unsigned int p) const
    {
      const dealii::Tensor<1, dim> row = dealii::Tensor<2, dim>(offsets(i))[p / 2];
      return p % 2 == 0 ? row : -row;
    }

    /// Calls visit(p, gradient) for the points of an owned cell, of the gradients and moments read.
    template <typename Visit>
    void visit(const GradientMoments<dim> &moments, const LocalIndex i, const Visit &visit) const
    {
      const auto q    = offsets(i);
      const auto mean = to_tensor<dim>(moments.gradient(i));
      for (unsigned int k = 0; k < dim; ++k)
        {
          dealii::Tensor<2, dim> change;
          for (unsigned int m = 0; m < dim; ++m)
            change += q[k][m] * to_tensor<dim>(moments.moment(i) + dim * m);
          visit(2 * k, mean + change);
          visit(2 * k + 1, mean - change);
        }
    }

    /// Puts what acts on the gradient and its moments of an owned cell in their places.
    /// @param stress_of P [Pa] by point and gradient there
    template <typename StressOf>
    void
    turn_into_stress(const GradientMoments<dim> &moments, const LocalIndex i, const StressOf &stress_of) const
    {
      dealii::Tensor<2, dim>                  sum;
      std::array<dealii::Tensor<2, dim>, dim> difference;
      // Of a cell that does not count nobody asks its law.
      if (const double of_point = weight(i); of_point != 0.)
        visit(moments, i, [&](const unsigned int p, const dealii::Tensor<2, dim> &gradient) {
          const dealii::Tensor<2, dim> stress = of_point * stress_of(p, gradient);
          sum += stress;
          difference[p / 2] += p % 2 == 0 ? stress : -stress;
        });
      const auto q = offsets(i);
      write(sum, moments.gradient(i));
      for (unsigned int m = 0; m < dim; ++m)
        {
          dealii::Tensor<2, dim> on_moment;
          for (unsigned int k = 0; k < dim; ++k)
            on_moment += q[k][m] * difference[k];
          write(on_moment, moments.moment(i) + dim * m);
        }
    }

    /// The same with all points on one side of the centroid at once: stress_of(side, gradient) gives P [Pa]
    /// there, side 0 being the positive one.
    template <typename StressOf>
    PERIDEAL_INLINE void turn_into_stress_at_once(const GradientMoments<dim> &moments,
                                                  const LocalIndex            i,
                                                  const StressOf             &stress_of) const
    {
      const PointLanes<dim>   at_once(offsets(i));
      PointTensor<dim, Lanes> gradient[2];
      at_once.at_points(moments.gradient(i), moments.moment(i), gradient[0], gradient[1]);
      at_once.sum(stress_of(0, gradient[0]),
                  stress_of(1, gradient[1]),
                  weight(i),
                  moments.gradient(i),
                  moments.moment(i));
    }

    std::size_t memory_consumption() const
    {
      return volume.size() * sizeof(double) + offset.size() * sizeof(offset[0]);
    }

  private:
    using Symmetric = SymmetricPairs<dim>;

    static void write(const dealii::Tensor<2, dim> &from, NodeRecord *t)
    {
      std::fill_n(t, dim, NodeRecord{});
      add_columns(from, t);
    }

    std::vector<double>                    volume;
    std::shared_ptr<const CellShares>      shares;
    std::vector<typename Symmetric::Pairs> offset;
  };
} // namespace perideal

#endif
