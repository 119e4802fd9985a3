// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/quadrature/regular_body.h>

#include "bodies.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;

namespace
{
  /// Error of int |xi| dV over that of the ball.
  template <int dim>
  double error_of(const std::string &scheme)
  {
    QuadratureParameters quadrature;
    quadrature.scheme   = choice_of<QuadratureScheme>(scheme);
    const double factor = 3., exact = dim == 3 ? dealii::numbers::PI * std::pow(factor, 4) :
                                                 2. * dealii::numbers::PI / 3. * std::pow(factor, 3);
    return std::abs(
      regular_first_moment<dim>(NodeParameters{factor, HorizonShape::sphere}, quadrature) / exact - 1.);
  }
} // namespace

TEST(RegularBody, HasTheFirstMomentOfTheBall)
{
  // One point misjudges the rim; the volumes cut exactly leave the error of distances within cells.
  EXPECT_LT(error_of<2>("exact"), 0.02);
  EXPECT_LT(error_of<3>("exact"), 0.03);
  EXPECT_LT(error_of<3>("gauss points"), 0.03);
  EXPECT_GT(error_of<3>("cubic cell"), 0.05);
}

TEST(RegularBody, IsWhatTheInsideOfALargerBodySees)
{
  for (const std::string scheme : {"one point", "cubic cell", "partial volume", "exact"})
    {
      const auto           mesh = test::make_box<2>({11, 11}, {5.5, 5.5}, 0.);
      const test::Body<2>  body(*mesh, 3.01, "sphere", scheme);
      QuadratureParameters quadrature;
      quadrature.scheme  = choice_of<QuadratureScheme>(scheme);
      const double whole = regular_first_moment<2>(NodeParameters{3.01, HorizonShape::sphere}, quadrature);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        if (body.nodes.position[i].distance(dealii::Point<2>(2.75, 2.75)) < 0.1)
          {
            EXPECT_NEAR(first_moment(*body.families, i), whole * std::pow(0.5, 3), 1e-12) << scheme;
          }
    }
}
