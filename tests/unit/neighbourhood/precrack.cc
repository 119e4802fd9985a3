// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/neighbourhood/precrack.h>

#include "testing.h"

using namespace perideal;
using test::expect_input_error;

TEST(Precrack, LinesCutWhatCrossesThem)
{
  const Precrack<2> crack({"c", "0, 0.5; 0.5, 0.5; 0.75, 0.75"});
  EXPECT_TRUE(crack.crosses({0.2, 0.4}, {0.2, 0.6}));
  EXPECT_TRUE(crack.crosses({0.2, 0.6}, {0.3, 0.4}));
  EXPECT_TRUE(crack.crosses({0.6, 0.7}, {0.6, 0.5}));
  EXPECT_FALSE(crack.crosses({0.2, 0.6}, {0.3, 0.7}));
  EXPECT_FALSE(crack.crosses({0.8, 0.7}, {0.8, 0.9}));
  // Through the tip: cut. Beside it: not.
  EXPECT_TRUE(crack.crosses({0.7, 0.8}, {0.8, 0.7}));
  EXPECT_FALSE(crack.crosses({0.7, 0.801}, {0.801, 0.7}));
  // A point on the crack belongs to one side of it.
  EXPECT_NE(crack.crosses({0.2, 0.5}, {0.2, 0.6}), crack.crosses({0.2, 0.5}, {0.2, 0.4}));
}

TEST(Precrack, PolygonsCutWhatCrossesThem)
{
  // An L in the plane x + y + z = 1.
  const Precrack<3>          crack({"c", "1,0,0; 0,1,0; 0,0,1; 0.3,0.3,0.4"});
  const dealii::Tensor<1, 3> normal(dealii::Point<3>(0.1, 0.1, 0.1));
  const auto cuts = [&](const dealii::Point<3> &x) { return crack.crosses(x - normal, x + normal); };
  EXPECT_TRUE(cuts({0.2, 0.5, 0.3}));
  EXPECT_FALSE(cuts({0.5, 0.2, 0.3})); // in the notch of the polygon
  EXPECT_FALSE(cuts({-0.2, 0.6, 0.6}));
  EXPECT_TRUE(cuts({0.5, 0.5, 0.}));  // on the edge
  EXPECT_TRUE(cuts({0.3, 0.3, 0.4})); // at a corner
  EXPECT_FALSE(crack.crosses({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}));
}

TEST(Precrack, WrongTextIsAnError)
{
  expect_input_error([] { Precrack<2>({"c", "0, 1"}); }, {"Precracks/c/Points", "two points"});
  expect_input_error([] { Precrack<2>({"c", "0, 1; 0, 1"}); }, {"Precracks/c/Points", "twice"});
  expect_input_error([] { Precrack<2>({"c", "0, 1, 2; 0, 1, 3"}); }, {"Precracks/c/Points", "2 coordinates"});
  expect_input_error([] { Precrack<3>({"c", "0,0,0; 1,0,0"}); }, {"Precracks/c/Points", "three points"});
  expect_input_error(
    [] {
      Precrack<3>({"c", "0,0,0; 1,0,0; 2,0,0"});
    },
    {"Precracks/c/Points", "plane polygon"});
  expect_input_error(
    [] {
      Precrack<3>({"c", "0,0,0; 1,0,0; 1,1,0; 0,1,1"});
    },
    {"Precracks/c/Points", "plane polygon"});
}
