// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/softening.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;

namespace
{
  constexpr double s_d = 2e-3;

  /// The force at a stretch, over the stiffness.
  double force(const SofteningLaw &law, const double stretch, const double first)
  {
    return stretch * (stretch > first ? law.carried(stretch, first, s_d * s_d) : 1.);
  }
} // namespace

TEST(Softening, TakesAsMuchAsBreakingAtOnce)
{
  for (const char *name : {"linear", "bilinear", "exponential"})
    for (const double ratio : {2.2, 3., 20.})
      {
        SCOPED_TRACE(name);
        const SofteningLaw law((Softening(name)));
        const double       first = s_d / std::sqrt(ratio), last = law.last(first, s_d * s_d);
        constexpr int      n    = 200000;
        double             area = 0;
        for (int k = 0; k < n; ++k)
          area += force(law, last * (k + 0.5) / n, first) * last / n;
        EXPECT_NEAR(area / (0.5 * s_d * s_d), 1., 1e-6);
        EXPECT_EQ(law.carried(1.0001 * last, first, s_d * s_d), 0.);
        // It begins with all, and falls on and on.
        EXPECT_NEAR(law.carried(first * (1. + 1e-9), first, s_d * s_d), 1., 1e-6);
        for (const double share : {0.05, 0.3, 0.6, 0.95})
          {
            const double s = first + share * (last - first), step = 1e-6 * s;
            EXPECT_NEAR((law.carried(s + step, first, s_d * s_d) - law.carried(s - step, first, s_d * s_d)) /
                          (2 * step),
                        law.slope(s, first, s_d * s_d),
                        1e-4 / first);
            EXPECT_LE(force(law, s + step, first), force(law, s, first) * (1 + 1e-12));
            EXPECT_NEAR(law.stretch_bearing(force(law, s, first) / first, first, s_d * s_d), s, 1e-12 * s);
          }
      }
}

TEST(Softening, FollowsABondAsItOpens)
{
  for (const char *name : {"linear", "bilinear", "exponential"})
    for (const unsigned int n : {7u, 1000u})
      {
        SCOPED_TRACE(name);
        const SofteningLaw  law((Softening(name)));
        const double        first = s_d / 2., last = law.last(first, s_d * s_d), scale = 0.7;
        std::vector<double> unit, inverse, result(n, -1.);
        for (unsigned int k = 0; k < n; ++k)
          {
            unit.push_back(1.1 * last / scale * k / n);
            inverse.push_back(k > 0 ? 1. / unit.back() : 0.);
          }
        law.look_along({unit.data(), inverse.data(), n}, scale, first, s_d * s_d, result.data());
        for (unsigned int k = 0; k < n; ++k)
          {
            const double stretch = scale * unit[k];
            EXPECT_NEAR(result[k], stretch > first ? law.carried(stretch, first, s_d * s_d) : 1., 1e-13);
          }
        // Pressed together it stays whole.
        law.look_along({unit.data(), inverse.data(), n}, -scale, first, s_d * s_d, result.data());
        EXPECT_EQ(result, std::vector<double>(n, 1.));
      }
}

TEST(Softening, TellsWhichBondsWouldSnapBack)
{
  const SofteningLaw linear("linear"), bilinear("bilinear"), none("none");
  EXPECT_TRUE(linear.is_stable(s_d / std::sqrt(1.01), s_d * s_d));
  EXPECT_FALSE(linear.is_stable(1.01 * s_d, s_d * s_d));
  // From Petersson's first line, which falls by 2/3 over an opening of .8.
  EXPECT_TRUE(bilinear.is_stable(s_d / std::sqrt(1.68), s_d * s_d));
  EXPECT_FALSE(bilinear.is_stable(s_d / std::sqrt(1.65), s_d * s_d));
  EXPECT_FALSE(none.is_stable(0.1 * s_d, s_d * s_d));
}
