// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/crack_tracker.h>
#include <perideal/fracture/fragments.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>
#include <fstream>

using namespace perideal;
using test::expect_input_error;

namespace
{
  CrackParameters parameters_of(const CrackText &text)
  {
    CrackParameters result;
    result.cracks = {text};
    return result;
  }

  /// Rows by time, the reach the largest distance so far.
  void expect_path(const std::string &file, const double reach)
  {
    std::ifstream stream(file);
    std::string   line;
    std::getline(stream, line);
    EXPECT_EQ(line, "time [s],x [m],y [m],distance [m],reach [m]");
    double       last_time = 0, largest = 0;
    unsigned int n_rows = 0;
    while (std::getline(stream, line))
      {
        const auto row = dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(line, ','));
        ASSERT_EQ(row.size(), 5u);
        EXPECT_GE(row[0], last_time);
        last_time = row[0];
        largest   = std::max(largest, row[3]);
        EXPECT_EQ(row[4], largest);
        EXPECT_NEAR(std::hypot(row[1] - 0.2, row[2] - 0.2), row[3], 1e-14);
        ++n_rows;
      }
    EXPECT_NEAR(largest, reach, 1e-8);
    EXPECT_GT(n_rows, 50u);
  }
} // namespace

/// A crack at 30 degrees that runs at 2 m/s, and a damaged spot elsewhere that is none of it.
TEST(CrackTracker, MeasuresAngleSpeedAndArrivals)
{
  const auto     mesh = test::make_box<2>({80, 80}, {1., 1.}, 0.);
  const Nodes<2> nodes(*mesh, NodeParameters{3.01});
  CrackText      text;
  text.name     = "c";
  text.origin   = "0.2, 0.2";
  text.side     = "0, 1";
  text.from     = 0.1;
  text.to       = 0.5;
  text.arrivals = {0.2, 0.4, 0.9};
  CrackTracker<2> tracker(parameters_of(text), nodes);
  tracker.start(std::vector<double>(nodes.size(), 0.));

  const dealii::Point<2> origin(0.2, 0.2), along(std::cos(dealii::numbers::PI / 6), 0.5);
  for (unsigned int n = 0; n <= 60; ++n)
    {
      const double        time = 0.005 * n;
      std::vector<double> damage(nodes.size(), 0.);
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          const auto   x       = nodes.position[i] - origin;
          const double forward = x * along, aside = std::abs(x[0] * along[1] - x[1] * along[0]);
          if (forward > -0.05 && forward < 2 * time && aside < 0.012)
            damage[i] = 0.5;
          if (nodes.position[i].distance({0.9, 0.1}) < 0.05)
            damage[i] = 0.9;
        }
      tracker.update(time, damage);
      // Now and then: cracks grow from where they were.
      if (n % 9 == 0)
        tracker.collect();
    }
  tracker.collect();
  const test::TemporaryDirectory directory;
  tracker.write_paths(directory.path());
  const auto crack = tracker.describe()["c"];
  const auto tip   = tracker.tips(0.3).at(0);
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return;
  // Within half a cell's diagonal and the crack's width; the speed over 8 spacings within one of them.
  EXPECT_NEAR((tip.position - origin) * along, 0.6, 0.02);
  EXPECT_NEAR(tip.reach, 0.6, 0.02);
  EXPECT_NEAR(tip.speed, 2., 0.25);
  EXPECT_NEAR(tracker.tips(10.)[0].speed, 0.01, 0.002); // 8 spacings in 9.75 s
  expect_path(directory.path("crack_c.csv"), tip.reach);
  EXPECT_NEAR(crack["angle"].get<double>(), 30., 1.);
  EXPECT_NEAR(crack["speed"].get<double>(), 2., 0.05);
  EXPECT_NEAR(crack["reach"].get<double>(), 0.6, 0.02);
  EXPECT_NEAR(crack["arrivals"][0].get<double>(), 0.1, 0.01);
  EXPECT_NEAR(crack["arrivals"][1].get<double>(), 0.2, 0.01);
  EXPECT_TRUE(crack["arrivals"][2].is_null());
  EXPECT_LE(crack["first_time"].get<double>(), 0.02);
}

/// What precracks have damaged is no crack; where nothing happens there is nothing to tell.
TEST(CrackTracker, LeavesPrecracksOut)
{
  const auto     mesh = test::make_box<2>({10, 10}, {1., 1.}, 0.);
  const Nodes<2> nodes(*mesh, NodeParameters{3.01});
  CrackText      text;
  text.name   = "c";
  text.origin = "0.5, 0.5";
  CrackTracker<2> tracker(parameters_of(text), nodes);
  tracker.start(std::vector<double>(nodes.size(), 0.34));
  tracker.update(1., std::vector<double>(nodes.size(), 0.9));
  tracker.collect();
  const auto crack = tracker.describe()["c"];
  const auto tip   = tracker.tips(1.).at(0);
  EXPECT_TRUE(std::isnan(tip.position[0]));
  EXPECT_EQ(tip.reach, 0.);
  EXPECT_EQ(tip.speed, 0.);
  EXPECT_TRUE(crack["first_time"].is_null());
  EXPECT_TRUE(crack["angle"].is_null());
}

TEST(CrackTracker, WrongTextIsAnError)
{
  const auto     mesh = test::make_box<2>({4, 4}, {1., 1.}, 0.);
  const Nodes<2> nodes(*mesh, NodeParameters{3.01});
  CrackText      text;
  text.name = "c";
  expect_input_error([&] { CrackTracker<2>(parameters_of(text), nodes); },
                     {"Cracks/c/Origin", "2 coordinates"});
  text.origin    = "0, 0";
  text.direction = "0, 0";
  expect_input_error([&] { CrackTracker<2>(parameters_of(text), nodes); },
                     {"Cracks/c/Direction", "no length"});
}

/// A damaged cross parts a square in four; a damaged corner cell alone is dust.
TEST(Fragments, AreWhatDamageParts)
{
  const auto          mesh = test::make_box<2>({32, 32}, {1., 1.}, 0.1);
  const test::Body<2> body(*mesh);
  std::vector<double> damage(body.nodes.size(), 0.);
  EXPECT_EQ(find_fragments(*body.families, BondList(*body.families), body.nodes.spacing, damage, 0.35).size(),
            1u);
  for (LocalIndex i = 0; i < body.nodes.size(); ++i)
    for (int d = 0; d < 2; ++d)
      if (std::abs(body.nodes.position[i][d] - 0.25) < 0.04)
        damage[i] = 0.6;
  const auto pieces =
    find_fragments(*body.families, BondList(*body.families), body.nodes.spacing, damage, 0.35);
  ASSERT_EQ(pieces.size(), 4u);
  EXPECT_GT(pieces[0], 0.45);
  EXPECT_NEAR(pieces[1], pieces[2], 0.02);
  EXPECT_LT(pieces[3], 0.08);
}
