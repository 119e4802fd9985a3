// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/crack_tips.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace perideal;

namespace
{
  using Segment = std::vector<dealii::Point<2>>;
}

/// A line with a kink, its parts in any order: two tips, each with the direction of its own part.
TEST(CrackEnds, OfALineAreItsTwoTips)
{
  const std::vector<Facet<2>> line = {Facet<2>(Segment{{2., 0.}, {3., 1.}}),
                                      Facet<2>(Segment{{1., 0.}, {0., 0.}}),
                                      Facet<2>(Segment{{1., 0.}, {2., 0.}})};
  const auto                  ends = ends_of(line, 7);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0].middle(), dealii::Point<2>(0., 0.));
  EXPECT_EQ(ends[0].direction, (dealii::Tensor<1, 2>({-1., 0.})));
  EXPECT_EQ(ends[1].middle(), dealii::Point<2>(3., 1.));
  EXPECT_NEAR(ends[1].direction[0], std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(ends[1].direction[1], std::sqrt(0.5), 1e-15);
  EXPECT_EQ(ends[1].crack, 7u);
}

TEST(CrackEnds, OfAPlaneAreItsEdges)
{
  using Polygon                      = std::vector<dealii::Point<3>>;
  const std::vector<Facet<3>> halves = {
    Facet<3>(Polygon{{0., 0., 0.}, {1., 0., 0.}, {1., 2., 0.}, {0., 2., 0.}}),
    Facet<3>(Polygon{{1., 0., 0.}, {2., 0., 0.}, {2., 2., 0.}, {1., 2., 0.}})};
  const auto ends = ends_of(halves, 0);
  // Eight edges, of which the halves share one.
  EXPECT_EQ(ends.size(), 6u);
  const auto right = std::max_element(
    ends.begin(), ends.end(), [](const auto &a, const auto &b) { return a.middle()[0] < b.middle()[0]; });
  EXPECT_EQ(right->middle(), dealii::Point<3>(2., 1., 0.));
  EXPECT_NEAR((right->direction - dealii::Tensor<1, 3>({1., 0., 0.})).norm(), 0., 1e-15);
  EXPECT_EQ(right->nearest({3., 0.5, 1.}), dealii::Point<3>(2., 0.5, 0.));
  EXPECT_EQ(right->nearest({3., 9., 1.}), dealii::Point<3>(2., 2., 0.));
}

/// Nodes on both sides of a line from (1, 0) on at 30 degrees, and the line along which the crack came.
TEST(GrowingTip, IsTheEndOfTheLastPart)
{
  const double                  c = std::cos(dealii::numbers::PI / 6.), s = 0.5;
  std::vector<dealii::Point<2>> damaged, before;
  for (unsigned int k = 0; k <= 20; ++k)
    {
      before.emplace_back(0.05 * k, 0.);
      for (const double aside : {-0.025, 0.025})
        damaged.emplace_back(1. + 0.05 * k * c - aside * s, 0.05 * k * s + aside * c);
    }
  const auto tip = find_growing_tip(damaged, {1., 0.}, before, 0.45, 0.05);
  ASSERT_TRUE(tip);
  EXPECT_NEAR(tip->direction[0], c, 0.01);
  EXPECT_NEAR(tip->direction[1], s, 0.01);
  EXPECT_NEAR(tip->position.distance({1. + c, s}), 0., 0.03);
  // All of it is straight.
  EXPECT_GT(tip->straight, 1e300);
}

TEST(GrowingTip, KnowsWhereTheCrackTurned)
{
  std::vector<dealii::Point<2>> damaged;
  for (unsigned int k = 0; k <= 20; ++k)
    damaged.emplace_back(0.05 * k, 0.);
  for (unsigned int k = 1; k <= 20; ++k)
    damaged.emplace_back(1., 0.05 * k);
  const auto tip = find_growing_tip(damaged, {0., 0.}, {}, 0.45, 0.05);
  ASSERT_TRUE(tip);
  EXPECT_NEAR(tip->direction[1], 1., 1e-12);
  EXPECT_NEAR(tip->straight, 1., 0.05);
}

TEST(GrowingTip, NeedsALine)
{
  EXPECT_FALSE(find_growing_tip({}, {0., 0.}, {}, 1., 0.1));
  // A patch has no direction.
  EXPECT_FALSE(find_growing_tip({{0., 0.}, {0.1, 0.}, {0., 0.1}, {0.1, 0.1}}, {-1., 0.}, {}, 1., 0.1));
}
