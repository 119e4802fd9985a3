// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/boundary_compensation.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;
using dealii::numbers::PI;

namespace
{
  /// The factor by numbers: int r^dim times the part of the circle or sphere of radius r above the plane.
  template <int dim>
  double by_numbers(const double h)
  {
    const dealii::QGauss<1> gauss(60);
    double                  part = 0;
    const auto              add  = [&](const double from, const double to, const auto &share) {
      for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          // The slope of acos(h/r) has no bound at r = h: squared spacing.
          const double t = gauss.point(q)[0], r = from + (to - from) * t * t;
          part += (to - from) * 2. * t * gauss.weight(q) * std::pow(r, dim) * share(r);
        }
    };
    add(0., h, [](const double) { return 1.; });
    add(h, 1., [&](const double r) { return dim == 3 ? 0.5 * (1. + h / r) : 1. - std::acos(h / r) / PI; });
    return 1. / (dim + 1.) / part;
  }
} // namespace

TEST(BoundaryCompensation, IsTheEnergyThatThePlaneTakes)
{
  for (const double h : {0., 0.1, 0.3, 0.5, 0.8, 0.99, 1.})
    {
      EXPECT_NEAR(plane_compensation<3>(2.5, 2.5 * h), by_numbers<3>(h), 1e-12) << h;
      EXPECT_NEAR(plane_compensation<2>(2.5, 2.5 * h), by_numbers<2>(h), 1e-10) << h;
    }
  EXPECT_DOUBLE_EQ(plane_compensation<3>(1., 0.), 2.);
  EXPECT_DOUBLE_EQ(plane_compensation<3>(1., 1.), 1.);
}

TEST(BoundaryCompensation, OfPlanesIsExactInCorners)
{
  // A quarter and an eighth of the sphere are left; planes out of reach change nothing.
  EXPECT_DOUBLE_EQ(plane_compensation<3>(1., std::vector<double>{0., 0.}), 4.);
  EXPECT_DOUBLE_EQ(plane_compensation<3>(1., std::vector<double>{0., 0., 0.}), 8.);
  EXPECT_NEAR(plane_compensation<2>(1., std::vector<double>{0., 0.}), 4., 1e-14);
  EXPECT_DOUBLE_EQ(plane_compensation<3>(1., std::vector<double>{0.3, 1., 2.}),
                   plane_compensation<3>(1., 0.3));
  EXPECT_DOUBLE_EQ(plane_compensation<3>(1., std::vector<double>{}), 1.);
}
