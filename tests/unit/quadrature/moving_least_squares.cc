// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/quadrature/moving_least_squares.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace perideal;

namespace
{
  /// Points of a grid of unit cells around @p middle, moved at random by up to @p disorder.
  template <int dim>
  std::vector<dealii::Point<dim>> scattered(const dealii::Point<dim> &middle, const double disorder)
  {
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> shift(-disorder, disorder);
    std::vector<dealii::Point<dim>>        result;
    for (int k = 0; k < std::pow(9, dim); ++k)
      {
        dealii::Point<dim> point = middle;
        for (int d = 0, rest = k; d < dim; ++d, rest /= 9)
          point[d] += rest % 9 - 4 + shift(random);
        result.push_back(point);
      }
    return result;
  }

  template <int dim>
  double quadratic(const dealii::Tensor<1, dim> &x)
  {
    double result = 3. - x[0] + 0.5 * x[dim - 1];
    for (int d = 0; d < dim; ++d)
      for (int e = d; e < dim; ++e)
        result += (1. + d - 0.3 * e) * x[d] * x[e];
    return result;
  }

  template <int n>
  struct Dimension
  {
    static constexpr int value = n;
  };
} // namespace

template <typename T>
class MovingLeastSquaresOf : public testing::Test
{
};
using Dimensions = testing::Types<Dimension<2>, Dimension<3>>;
TYPED_TEST_SUITE(MovingLeastSquaresOf, Dimensions);

TYPED_TEST(MovingLeastSquaresOf, QuadraticFieldsComeOutExactly)
{
  constexpr int      dim = TypeParam::value;
  dealii::Point<dim> middle;
  middle[0]         = 1000.; // far from the origin: the basis is about x
  const auto points = scattered<dim>(middle, 0.3);

  MovingLeastSquares<dim> fit;
  for (const double offset : {0., 0.37, -0.5, 4.2 /* outside the points */})
    {
      dealii::Point<dim> x = middle;
      x[0] += offset;
      x[1] -= offset / 3;
      ASSERT_TRUE(fit.reinit(x, points, 3.)) << fit.problem();
      double value = 0;
      for (std::size_t k = 0; k < points.size(); ++k)
        {
          value += fit.weights()[k] * quadratic<dim>(points[k] - middle);
          EXPECT_EQ(fit.weights()[k] != 0., points[k].distance(x) < 3.);
        }
      EXPECT_NEAR(value, quadratic<dim>(x - middle), 1e-11);
    }
}

TYPED_TEST(MovingLeastSquaresOf, WeightsAreThoseOfDistanceAndRadius)
{
  // Points opposite each other count alike, and the spline depends on the radius.
  constexpr int           dim    = TypeParam::value;
  const auto              points = scattered<dim>(dealii::Point<dim>(), 0.);
  MovingLeastSquares<dim> fit;
  ASSERT_TRUE(fit.reinit(dealii::Point<dim>(), points, 2.2));
  const auto narrow = fit.weights();
  ASSERT_TRUE(fit.reinit(dealii::Point<dim>(), points, 3.));
  double difference = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
    {
      difference += std::abs(fit.weights()[k] - narrow[k]);
      // The grid from its other end.
      EXPECT_NEAR(fit.weights()[k], fit.weights()[points.size() - 1 - k], 1e-13);
    }
  EXPECT_GT(difference, 0.05);
}

TYPED_TEST(MovingLeastSquaresOf, SupportsThatMakeNoFitAreRefused)
{
  constexpr int           dim = TypeParam::value;
  MovingLeastSquares<dim> fit;
  const auto              points = scattered<dim>(dealii::Point<dim>(), 0.);
  EXPECT_FALSE(fit.reinit(dealii::Point<dim>(), points, 0.9));
  EXPECT_NE(fit.problem().find("1 points"), std::string::npos) << fit.problem();

  // Many points in a plane (on a line): no slope across it.
  auto flat = points;
  for (auto &point : flat)
    point[dim - 1] = 0.;
  EXPECT_FALSE(fit.reinit(dealii::Point<dim>(), flat, 3.));
  EXPECT_NE(fit.problem().find("general position"), std::string::npos) << fit.problem();

  // Two planes: a slope, but no curvature.
  for (std::size_t k = 0; k < flat.size(); ++k)
    flat[k][dim - 1] = k % 2;
  EXPECT_FALSE(fit.reinit(dealii::Point<dim>(), flat, 3.));
}
