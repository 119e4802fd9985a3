// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/reconstruction/polynomial_closure.h>
#include <perideal/reconstruction/quadratic_fit.h>

#include "bodies.h"
#include "solids.h"
#include "testing.h"

using namespace perideal;

namespace
{
  /// Quadratic coefficients of a displacement without pattern, lanes by component.
  template <int dim>
  std::array<NodeRecord, Monomials<dim>::n_terms> rough_terms(const unsigned int seed)
  {
    std::array<NodeRecord, Monomials<dim>::n_terms> result{};
    for (unsigned int t = 0; t < result.size(); ++t)
      for (int a = 0; a < dim; ++a)
        result[t].value[a] = test::scatter(dealii::Point<dim>(), 17 * seed + dim * t + a);
    return result;
  }

  /// Gradient of the strain of quadratic coefficients, by direction.
  template <int dim>
  std::array<dealii::SymmetricTensor<2, dim>, dim>
  strain_gradient(const std::array<NodeRecord, Monomials<dim>::n_terms> &terms)
  {
    std::array<dealii::SymmetricTensor<2, dim>, dim> result;
    for (unsigned int p = 0; p < Monomials<dim>::n_quadratic; ++p)
      {
        const auto [k, l] = SymmetricPairs<dim>::axes(p);
        for (unsigned int a = 0; a < dim; ++a)
          {
            // d_k d_l u_a; both orders of mixed derivatives, and twice the pure ones.
            dealii::Tensor<2, dim> of_k, of_l;
            of_k[a][l] = of_l[a][k] = terms[dim + p].value[a];
            result[k] += symmetrize(of_k);
            result[l] += symmetrize(of_l);
          }
      }
    return result;
  }

  /// sum_kl M_kl d_k eps(a) : C : d_l eps(b).
  template <int dim>
  double energy(const std::array<NodeRecord, Monomials<dim>::n_terms> &a,
                const std::array<NodeRecord, Monomials<dim>::n_terms> &b,
                const dealii::SymmetricTensor<2, dim>                 &second_moment,
                const dealii::SymmetricTensor<4, dim>                 &stiffness)
  {
    const auto of_a = strain_gradient<dim>(a), of_b = strain_gradient<dim>(b);
    double     sum = 0;
    for (int k = 0; k < dim; ++k)
      for (int l = 0; l < dim; ++l)
        sum += second_moment[k][l] * (of_a[k] * (stiffness * of_b[l]));
    return sum;
  }

  /// The cells of two layers around one of the lower layer, of unit size.
  template <int dim>
  std::vector<typename QuadraticFit<dim>::Cell> two_layers(const dealii::SymmetricTensor<2, dim> &moment)
  {
    std::vector<typename QuadraticFit<dim>::Cell> result;
    for (int up = 0; up <= 1; ++up)
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= (dim == 3 ? 1 : -1); ++y)
          {
            dealii::Tensor<1, dim> distance;
            distance[0]       = x;
            distance[1]       = dim == 3 ? y : 0;
            distance[dim - 1] = up;
            if (distance.norm() > 0)
              result.push_back({distance, moment});
          }
    return result;
  }

  template <int dim>
  void expect_square_across()
  {
    const auto        moment = 1. / 12. * dealii::unit_symmetric_tensor<dim>();
    QuadraticFit<dim> fit;
    fit.reinit(moment, two_layers<dim>(moment), moment);
    ASSERT_EQ(fit.n_determined(), Monomials<dim>::n_quadratic - 1);
    // z^2 - z, z upwards: nothing at the middles of both layers.
    const auto undetermined = fit.undetermined();
    ASSERT_EQ(undetermined.size(), 1u);
    const double scale = undetermined[0][dim + dim - 1];
    for (unsigned int t = 0; t < Monomials<dim>::n_terms; ++t)
      EXPECT_NEAR(undetermined[0][t] / scale, t == dim - 1 ? -1. : t == dim + dim - 1 ? 1. : 0., 1e-12);
    // A slope of a tenth turns the square; a surface that stands upright does not.
    dealii::Tensor<1, dim> slope, upright;
    slope[dim - 1]    = -2.;
    slope[0]          = 0.2;
    upright[0]        = 1.;
    const auto square = fit.squares_across({slope, upright});
    ASSERT_EQ(square.size(), 1u);
    EXPECT_NEAR(square[0][dim] / square[0][dim + dim - 1], 0.01, 1e-3);
    EXPECT_NEAR(square[0][dim + (dim == 2 ? 2 : 5)] / square[0][dim + dim - 1], -0.2, 1e-3);
    // Without surfaces it is the quadratic that is not determined.
    const auto own = fit.squares_across({});
    ASSERT_EQ(own.size(), 1u);
    for (unsigned int p = 0; p < Monomials<dim>::n_quadratic; ++p)
      EXPECT_NEAR(own[0][dim + p] / own[0][dim + dim - 1], p == dim - 1 ? 1. : 0., 1e-12);
  }

  template <int dim>
  void expect_no_traction_across()
  {
    using Terms                            = typename PolynomialClosure<dim>::Terms;
    dealii::SymmetricTensor<2, dim> moment = dealii::unit_symmetric_tensor<dim>();
    moment[0][1]                           = 0.2;
    moment[1][1]                           = 0.3;
    const auto stiffness                   = test::solid_without_symmetry<dim>().stiffness();
    // Two directions that are not quite the squares.
    std::vector<Terms> undetermined(2, Terms{}), across(2, Terms{});
    for (unsigned int j = 0; j < 2; ++j)
      {
        across[j][dim + j] = 1.;
        for (unsigned int t = 0; t < Monomials<dim>::n_terms; ++t)
          undetermined[j][t] = across[j][t] + 0.1 * test::scatter(dealii::Point<dim>(), 31 * j + t);
      }
    PolynomialClosure<dim> closure;
    closure.add(3, undetermined, across, moment, stiffness);
    EXPECT_EQ(closure.directions(3).size(), 2u);
    EXPECT_EQ(closure.directions(2).size(), 0u);

    const auto fitted = rough_terms<dim>(1);
    auto       closed = fitted;
    closure.close(0, &lanes(closed[0]));
    for (unsigned int j = 0; j < 2; ++j)
      for (int a = 0; a < dim; ++a)
        {
          std::array<NodeRecord, Monomials<dim>::n_terms> square{};
          square[dim + j].value[a] = 1.;
          const double size        = energy<dim>(square, fitted, moment, stiffness);
          EXPECT_LE(std::abs(energy<dim>(square, closed, moment, stiffness)), 1e-12 * std::abs(size));
        }
    // What was added is of the undetermined polynomials: their first terms tell how much.
    for (int a = 0; a < dim; ++a)
      {
        const auto   change = [&](const unsigned int t) { return closed[t].value[a] - fitted[t].value[a]; };
        const double determinant =
          undetermined[0][0] * undetermined[1][1] - undetermined[0][1] * undetermined[1][0];
        const double z0 = (change(0) * undetermined[1][1] - change(1) * undetermined[1][0]) / determinant;
        const double z1 = (change(1) * undetermined[0][0] - change(0) * undetermined[0][1]) / determinant;
        for (unsigned int t = 2; t < Monomials<dim>::n_terms; ++t)
          EXPECT_NEAR(change(t), z0 * undetermined[0][t] + z1 * undetermined[1][t], 1e-10);
      }

    // The transpose has the same work.
    const auto acting    = rough_terms<dim>(2);
    auto       on_fitted = acting;
    closure.add_transposed(0, &lanes(on_fitted[0]));
    double on_closed = 0, by_transpose = 0;
    for (unsigned int t = 0; t < Monomials<dim>::n_terms; ++t)
      for (int a = 0; a < dim; ++a)
        {
          on_closed += acting[t].value[a] * closed[t].value[a];
          by_transpose += on_fitted[t].value[a] * fitted[t].value[a];
        }
    EXPECT_NEAR(on_closed, by_transpose, 1e-12 * std::abs(on_closed));
  }
} // namespace

TEST(PolynomialClosure, TractionsDoNotVaryAcross2D)
{
  expect_no_traction_across<2>();
}
TEST(PolynomialClosure, TractionsDoNotVaryAcross3D)
{
  expect_no_traction_across<3>();
}
TEST(QuadraticFit, KnowsTheSquareAcrossTwoLayers2D)
{
  expect_square_across<2>();
}
TEST(QuadraticFit, KnowsTheSquareAcrossTwoLayers3D)
{
  expect_square_across<3>();
}
