// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bodies.h"
#include "testing.h"

#include <perideal/geometry/facets.h>

using namespace perideal;
using test::scatter;

TEST(Facet, MeasuresDistances)
{
  const Facet<2> segment({{0., 0.}, {1., 0.}});
  EXPECT_NEAR(segment.distance({0.5, -0.2}), 0.2, 1e-15);
  EXPECT_NEAR(segment.distance({1.3, 0.4}), 0.5, 1e-15);
  const Facet<3> square({{0., 0., 0.}, {1., 0., 0.}, {1., 1., 0.}, {0., 1., 0.}});
  EXPECT_NEAR(square.distance({0.5, 0.25, -0.2}), 0.2, 1e-15);
  EXPECT_NEAR(square.distance({1.3, 0.5, 0.4}), 0.5, 1e-15);
  EXPECT_NEAR(square.distance({1.2, 1.2, 0.1}), 0.3, 1e-15);
}

TEST(Facet, KnowsWhatIsNone)
{
  EXPECT_TRUE(Facet<2>({{0., 0.}, {1., 0.}}).is_valid());
  EXPECT_FALSE(Facet<2>({{1., 0.}, {1., 0.}}).is_valid());
  EXPECT_FALSE(Facet<3>({{0., 0., 0.}, {1., 0., 0.}, {2., 0., 0.}}).is_valid());
  EXPECT_FALSE(Facet<3>({{0., 0., 0.}, {1., 0., 0.}, {1., 1., 0.}, {0., 1., 1.}}).is_valid());
}

/// Among many facets the same are found as by trying them all.
TEST(Facets, AreFoundAmongMany)
{
  const auto random_point = [](const unsigned int seed) {
    dealii::Point<3> x;
    for (int d = 0; d < 3; ++d)
      x[d] = scatter(dealii::Point<1>(seed), d);
    return x;
  };
  std::vector<Facet<3>> list;
  for (unsigned int k = 0; k < 100; ++k)
    {
      const auto corner = random_point(k);
      list.emplace_back(std::vector<dealii::Point<3>>{
        corner, corner + 0.3 * random_point(1000 + k), corner + 0.3 * random_point(2000 + k)});
    }
  const Facets<3> facets(list);
  unsigned int    n_crossed = 0, n_near = 0;
  for (unsigned int k = 0; k < 1000; ++k)
    {
      const auto a       = random_point(3000 + k);
      const auto b       = a + 0.3 * random_point(4000 + k);
      bool       crossed = false, near = false;
      for (const auto &facet : list)
        {
          crossed = crossed || facet.is_crossed(a, b);
          near    = near || facet.distance(a) <= 0.05;
        }
      n_crossed += crossed;
      n_near += near;
      ASSERT_EQ(facets.are_crossed(a, b), crossed) << k;
      ASSERT_EQ(facets.are_within(0.05, a), near) << k;
    }
  EXPECT_GT(n_crossed, 20u);
  EXPECT_GT(n_near, 50u);
}
