// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/no_fail_zones.h>

#include "bodies.h"
#include "testing.h"

using namespace perideal;
using test::expect_input_error;

namespace
{
  NoFailParameters zone_of(const std::string &boundary, const double distance, const std::string &box)
  {
    NoFailParameters result;
    result.zones.push_back({"z", boundary, distance, box});
    return result;
  }

  template <int dim>
  GlobalIndex count(const Mesh<dim> &mesh, const NoFailParameters &parameters)
  {
    const Nodes<dim> nodes(mesh, NodeParameters{3.01});
    return NoFailZones<dim>(parameters, mesh).count(nodes);
  }
} // namespace

TEST(NoFailZones, HoldNodesNearBoundariesAndInBoxes)
{
  // Cells of 0.1: nodes at 0.05, 0.15, ...; boundary 0 is x = 0, in 3-D 4 is z = 0.
  const auto square = test::make_box<2>({10, 8}, {1., 0.8}, 0.);
  EXPECT_EQ(count(*square, zone_of("0", 0.2, "")), 2u * 8u);
  EXPECT_EQ(count(*square, zone_of("", 0, "0.2, 0.1; 0.4, 0.4")), 2u * 3u);
  EXPECT_EQ(count(*square, zone_of("0", 0.2, "-1, 0.6; 1, 1")), 2u * 2u);
  const auto cube = test::make_box<3>({5, 4, 10}, {0.5, 0.4, 1.}, 0.);
  EXPECT_EQ(count(*cube, zone_of("4", 0.31, "")), 20u * 3u);

  // Zones add up; what is in two counts once.
  NoFailParameters two = zone_of("0", 0.2, "");
  two.zones.push_back({"other", "", 0, "0.1, 0; 0.3, 0.8"});
  EXPECT_EQ(count(*square, two), 3u * 8u);
}

/// Distances are those from faces, not from the plane that they are in.
TEST(NoFailZones, EndWithTheBoundary)
{
  const auto           mesh = test::make_box<2>({10, 10}, {1., 1.}, 0.);
  const NoFailZones<2> zones(zone_of("2", 0.3, ""), *mesh);
  EXPECT_TRUE(zones.contains({0.5, 0.29}));
  EXPECT_FALSE(zones.contains({0.5, 0.31}));
  EXPECT_TRUE(zones.contains({1.2, 0.2}));
  EXPECT_FALSE(zones.contains({1.25, 0.2}));
}

TEST(NoFailZones, WrongTextIsAnError)
{
  const auto mesh = test::make_box<2>({4, 4}, {1., 1.}, 0.);
  expect_input_error([&] { count(*mesh, zone_of("", 0, "")); }, {"No-fail zones/z", "Boundary and Distance"});
  expect_input_error([&] { count(*mesh, zone_of("0", 0, "")); }, {"No-fail zones/z/Distance", "> 0"});
  expect_input_error([&] { count(*mesh, zone_of("", 1, "0, 0; 1, 1")); },
                     {"No-fail zones/z/Distance", "boundary"});
  expect_input_error([&] { count(*mesh, zone_of("9", 1, "")); },
                     {"No-fail zones/z/Boundary", "9", "allowed:"});
  expect_input_error([&] { count(*mesh, zone_of("", 0, "0, 0")); }, {"No-fail zones/z/Box", "two corners"});
  expect_input_error([&] { count(*mesh, zone_of("", 0, "0, 0; 1, 0")); },
                     {"No-fail zones/z/Box", "no inside"});
  expect_input_error([&] { count(*mesh, zone_of("", 0, "2, 2; 3, 3")); }, {"No-fail zones/z", "no node"});
}
