// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/singular_exponents.h>

#include "testing.h"

#include <deal.II/base/numbers.h>

using namespace perideal;
using dealii::numbers::PI;

TEST(SingularExponents, OfFreeCornersAreThoseOfWilliams)
{
  // 1 - .544484, 1 - .615731, 1 - .673583 of 270, 240 and 225 degrees.
  EXPECT_NEAR(exponent_of_free_corner(1.5 * PI), 0.455516, 1e-6);
  EXPECT_NEAR(exponent_of_free_corner(4. / 3. * PI), 0.384269, 1e-6);
  EXPECT_NEAR(exponent_of_free_corner(1.25 * PI), 0.326417, 1e-6);
  EXPECT_NEAR(exponent_of_free_corner(2. * PI), 0.5, 1e-9);
  EXPECT_NEAR(exponent_of_free_corner(PI), 0., 1e-9);
  EXPECT_EQ(exponent_of_free_corner(0.5 * PI), 0.);
}

TEST(SingularExponents, OfClampedCornersDependOnPoissonsRatio)
{
  // 1 - .711 of 90 degrees with nu = .3 in plane strain; none of 45 degrees; a flat one has 1/2 + i epsilon.
  EXPECT_NEAR(exponent_of_clamped_corner(0.5 * PI, 3. - 4. * 0.3), 0.289, 1e-3);
  EXPECT_NEAR(exponent_of_clamped_corner(0.5 * PI, 3. - 4. * 0.5), 0.4054, 1e-3);
  EXPECT_EQ(exponent_of_clamped_corner(0.25 * PI, 3. - 4. * 0.3), 0.);
  EXPECT_EQ(exponent_of_clamped_corner(PI, 3. - 4. * 0.3), 0.5);
}
