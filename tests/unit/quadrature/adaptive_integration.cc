// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/geometry/cell_in_ball.h>
#include <perideal/quadrature/adaptive_integration.h>

#include "testing.h"

#include <deal.II/base/numbers.h>

#include <cmath>
#include <random>

using namespace perideal;
using dealii::numbers::PI;

namespace
{
  /// Convex cells with plane faces, projective images of a cube, and balls that cut them.
  template <int dim>
  class RandomCuts
  {
  public:
    /// The next one of which more than a sliver is cut, and not all.
    void next()
    {
      do
        draw();
      while (!(part > 1e-3 * cell_volume<dim>(cell) && part < (1 - 1e-3) * cell_volume<dim>(cell)));
    }

    CellVertices<dim>  cell;
    dealii::Point<dim> centre;
    double             radius = 0, part = 0;

  private:
    double number() { return std::uniform_real_distribution<double>(-1, 1)(generator); }

    void draw()
    {
      dealii::Tensor<2, dim> map;
      dealii::Tensor<1, dim> taper;
      for (int d = 0; d < dim; ++d)
        {
          for (int e = 0; e < dim; ++e)
            map[d][e] = (d == e) + 0.3 * number();
          // The first two directions: some faces stay parallel.
          taper[d]  = d < 2 ? 0.3 * number() : 0.;
          centre[d] = 1.5 * number();
        }
      for (unsigned int v = 0; v < cell.size(); ++v)
        {
          dealii::Tensor<1, dim> corner;
          for (int d = 0; d < dim; ++d)
            corner[d] = (v >> d) & 1u ? 0.5 : -0.5;
          cell[v] = dealii::Point<dim>(map * corner / (1 + taper * corner));
        }
      radius = 0.2 + 1.4 * std::abs(number());
      part   = volume_in_ball<dim>(cell, centre, radius);
    }

    std::mt19937 generator{1};
  };

  template <int dim>
  double one(const dealii::Point<dim> &)
  {
    return 1.;
  }

  constexpr double no_absolute = 1e-12;

  /// How often a rule is off by more than its tolerance, and what it took.
  struct Record
  {
    unsigned int broken = 0, unfinished = 0;
    double       worst = 0, points = 0;
  };

  template <int dim>
  Record record(const unsigned int n, const IntegrationRule rule, const double tolerance)
  {
    RandomCuts<dim> cuts;
    Record          result;
    for (unsigned int k = 0; k < n; ++k)
      {
        cuts.next();
        const auto sum = integrate_cell_in_ball<dim>(
          one<dim>, cuts.cell, cuts.centre, cuts.radius, rule, {tolerance, no_absolute});
        const double error = std::abs(sum.value / cuts.part - 1);
        EXPECT_GE(sum.n_evaluations, sum.n_points);
        result.broken += error > tolerance;
        result.unfinished += !sum.converged;
        result.worst = std::max(result.worst, error);
        result.points += static_cast<double>(sum.n_points) / n;
      }
    std::cout << dim << "-D, " << (rule == IntegrationRule::gauss ? "gauss" : "trapezoid") << ", tolerance "
              << tolerance << ": " << result.broken << " of " << n << " cells off by more, "
              << result.unfinished << " not converged, worst error " << result.worst << ", " << result.points
              << " points\n";
    return result;
  }

  CellVertices<3> cube(const dealii::Point<3> &middle)
  {
    CellVertices<3> result;
    for (unsigned int v = 0; v < 8; ++v)
      for (int d = 0; d < 3; ++d)
        result[v][d] = middle[d] + ((v >> d) & 1u ? 0.5 : -0.5);
    return result;
  }
} // namespace

TEST(AdaptiveIntegration, GaussKeepsItsPromise)
{
  for (const double tolerance : {1e-4, 1e-6, 1e-9})
    {
      const Record solid = record<3>(tolerance > 1e-8 ? 1000 : 200, IntegrationRule::gauss, tolerance);
      EXPECT_EQ(solid.broken, 0u);
      EXPECT_EQ(solid.unfinished, 0u);
      const Record plane = record<2>(1000, IntegrationRule::gauss, tolerance);
      EXPECT_EQ(plane.broken, 0u);
      EXPECT_EQ(plane.unfinished, 0u);
    }
}

/// The thesis' rule promises as much and keeps it but for a few: halving stops where the change is small, and
/// that is not always where the error is.
TEST(AdaptiveIntegration, TrapezoidMostlyKeepsItsPromise)
{
  const Record solid = record<3>(100, IntegrationRule::trapezoid, 1e-2);
  EXPECT_LE(solid.broken, 4u);
  EXPECT_EQ(solid.unfinished, 0u);
  EXPECT_LT(solid.worst, 0.2);
  const Record plane = record<2>(1000, IntegrationRule::trapezoid, 1e-3);
  EXPECT_LE(plane.broken, 4u);
  EXPECT_EQ(plane.unfinished, 0u);
}

TEST(AdaptiveIntegration, WholeCellsConvergeAtOnce)
{
  const auto sum =
    integrate_cell_in_ball<3>(one<3>, cube({}), {}, 1., IntegrationRule::gauss, {1e-12, no_absolute});
  EXPECT_TRUE(sum.converged);
  EXPECT_EQ(sum.n_evaluations, 9u);
  EXPECT_NEAR(sum.value, 1., 1e-14);
  const auto halved =
    integrate_cell_in_ball<3>(one<3>, cube({}), {}, 1., IntegrationRule::trapezoid, {1e-12, no_absolute});
  EXPECT_TRUE(halved.converged);
  EXPECT_EQ(halved.n_evaluations, 8u + 27u);
  EXPECT_NEAR(halved.value, 1., 1e-12);
}

/// Functions that vary, in all directions, scalar and vector.
TEST(AdaptiveIntegration, Functions)
{
  RandomCuts<3> cuts;
  for (unsigned int k = 0; k < 20; ++k)
    {
      cuts.next();
      const auto exact = moments_in_ball<3>(cuts.cell, cuts.centre, cuts.radius);
      const auto sum =
        integrate_cell_in_ball<3>([](const dealii::Point<3> &x) -> dealii::Tensor<1, 3> { return x; },
                                  cuts.cell,
                                  cuts.centre,
                                  cuts.radius,
                                  IntegrationRule::gauss,
                                  {1e-8, no_absolute});
      EXPECT_TRUE(sum.converged);
      EXPECT_LT((sum.value - exact.moment).norm(), 1e-8 * exact.volume);
    }
  // A ball in a cell: the integral of e^z is 4 pi (cosh 1 - sinh 1).
  CellVertices<3> large = cube({});
  for (auto &vertex : large)
    vertex *= 3.;
  const auto sum = integrate_cell_in_ball<3>([](const dealii::Point<3> &x) { return std::exp(x[2]); },
                                             large,
                                             {},
                                             1.,
                                             IntegrationRule::gauss,
                                             {1e-8, no_absolute});
  EXPECT_NEAR(sum.value, 4 * PI * (std::cosh(1.) - std::sinh(1.)), 1e-8);
}

/// K. Yu's thesis, section 2.5.1: the sphere of 3 spacings to 0.05 % with 4,903 points.
TEST(AdaptiveIntegration, SphereOfThreeSpacings)
{
  double      volume = 0;
  std::size_t points = 0;
  const int   reach  = 4;
  for (int k = -reach; k <= reach; ++k)
    for (int j = -reach; j <= reach; ++j)
      for (int i = -reach; i <= reach; ++i)
        {
          const auto cell = cube(dealii::Point<3>(i, j, k));
          if (place_of<3>(cell, {}, 3.) == PlaceOfCell::outside)
            continue;
          const auto sum =
            integrate_cell_in_ball<3>(one<3>, cell, {}, 3., IntegrationRule::gauss, {1e-2, no_absolute});
          EXPECT_TRUE(sum.converged);
          volume += sum.value;
          points += sum.n_points;
        }
  // Measured 2.7e-6.
  EXPECT_NEAR(volume, 36 * PI, 1e-5 * 36 * PI);
  EXPECT_LT(points, 4903u);
}
