// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/crack_branching.h>
#include <perideal/fracture/crack_tracker.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>

using namespace perideal;

namespace
{
  constexpr double h = 0.01, fork_at = 0.3;

  /// Whether a point, from the origin along and across, is in a crack 3 cells wide that forks at an angle.
  bool in_fork(const double along, const double across, const double full_angle)
  {
    const double opening = std::tan(0.5 * full_angle * dealii::numbers::PI / 180);
    const double middle  = along < fork_at ? 0. : (along - fork_at) * opening;
    return along > 0 && std::abs(std::abs(across) - middle) < 1.5 * h;
  }

  /// Nodes on a lattice, shifted against the origin.
  std::vector<std::array<double, 2>> forked(const double full_angle, const double shift, const double length)
  {
    std::vector<std::array<double, 2>> nodes;
    for (int i = -5; (i + shift) * h < length; ++i)
      for (int j = -60; j <= 60; ++j)
        if (in_fork((i + shift) * h, (j + 0.5) * h, full_angle))
          nodes.push_back({{(i + shift) * h, (j + 0.5) * h}});
    return nodes;
  }
} // namespace

/// Bands are apart where the middles are 3.5 spacings and the width of a band apart.
TEST(CrackBranching, FindsPlaceAndAngle)
{
  for (const double angle : {30., 60.})
    for (const double shift : {0., 0.3, 0.5})
      {
        const auto found = find_branching(forked(angle, shift, 0.7), h, 0.2);
        ASSERT_TRUE(found.has_value()) << angle << ' ' << shift;
        const double apart = fork_at + 0.5 * 6 * h / std::tan(0.5 * angle * dealii::numbers::PI / 180);
        EXPECT_NEAR(found->reach, apart, 3 * h) << angle << ' ' << shift;
        // Steps of a cell on 0.2 leave 2 degrees or so.
        EXPECT_NEAR(found->full_angle, angle, 2.5) << angle << ' ' << shift;
        EXPECT_EQ(found->n_branches, 2u);
      }
}

TEST(CrackBranching, CountsBranches)
{
  // A third band in the middle of a wide fork, for long enough or not.
  for (const double length : {0.3, 0.1})
    {
      auto nodes = forked(60., 0.5, 0.9);
      for (double along = 0.55; along < 0.55 + length; along += h)
        nodes.push_back({{along, 0.}});
      const auto found = find_branching(nodes, h, 0.2);
      ASSERT_TRUE(found.has_value());
      EXPECT_EQ(found->n_branches, length > 12 * h ? 3u : 2u);
    }
}

TEST(CrackBranching, IsNotFoundInOneBandNorInShortSpurs)
{
  EXPECT_FALSE(find_branching(forked(0., 0.5, 0.7), h, 0.1).has_value());
  // The bands of 60 degrees are apart for fewer than twelve columns.
  EXPECT_FALSE(find_branching(forked(60., 0.5, fork_at + 0.13), h, 0.1).has_value());
  EXPECT_FALSE(find_branching({}, h, 0.1).has_value());
}

/// The tracker sees the fork in any direction, and when the tip was there.
TEST(CrackBranching, IsToldByTheTracker)
{
  const auto     mesh = test::make_box<2>({80, 100}, {0.8, 1.}, 0.);
  const Nodes<2> nodes(*mesh, NodeParameters{3.01});
  CrackText      text;
  text.name          = "c";
  text.origin        = "0.4, 0.1";
  text.direction     = "0, 2";
  text.branch_length = 0.2;
  CrackParameters parameters;
  parameters.cracks = {text};
  CrackTracker<2> tracker(parameters, nodes);
  tracker.start(std::vector<double>(nodes.size(), 0.));
  // 2 m/s along the direction.
  for (unsigned int n = 0; n <= 70; ++n)
    {
      std::vector<double> damage(nodes.size(), 0.);
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          const double along = nodes.position[i][1] - 0.1, across = nodes.position[i][0] - 0.4;
          if (along < 0.01 * n && in_fork(along, across, 60.))
            damage[i] = 0.5;
        }
      tracker.update(0.005 * n, damage);
      if (n % 7 == 0)
        tracker.collect();
    }
  const auto branching = tracker.describe()["c"]["branching"];
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
    return;
  EXPECT_NEAR(branching["full_angle"].get<double>(), 60., 2.5);
  EXPECT_NEAR(branching["reach"].get<double>(), 0.352, 0.03);
  EXPECT_NEAR(branching["time"].get<double>(), branching["reach"].get<double>() / 2, 0.006);
}

TEST(CrackBranching, IsTwoDimensional)
{
  const auto     mesh = test::make_box<3>({4, 4, 4}, {1., 1., 1.}, 0.);
  const Nodes<3> nodes(*mesh, NodeParameters{3.01});
  CrackText      text;
  text.name          = "c";
  text.origin        = "0, 0, 0";
  text.branch_length = 0.2;
  CrackParameters parameters;
  parameters.cracks = {text};
  test::expect_input_error([&] { CrackTracker<3>(parameters, nodes); }, {"Cracks/c/Branch length", "two"});
}
