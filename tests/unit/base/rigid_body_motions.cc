// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/rigid_body_motions.h>

#include "testing.h"

#include <mpi.h>

using namespace perideal;

TEST(RigidBodyMotions, NothingHeldLeavesAllFree)
{
  const RigidBodyMotions<3> motions({0.5, 0.5, 0.5}, 1.);
  const auto                free = motions.free_motions(MPI_COMM_SELF);
  EXPECT_EQ(free.size(), 6u);
  EXPECT_EQ(RigidBodyMotions<3>::describe(free),
            "translation in x, translation in y, translation in z, rotation about x, rotation about y, "
            "rotation about z");
}

TEST(RigidBodyMotions, RollersAtTwoEndsLeaveOneTranslation)
{
  RigidBodyMotions<2> motions({0., 0.}, 1.);
  for (const double y : {-0.5, 0.5})
    for (const double x : {-0.5, 0.5})
      motions.hold({x, y}, 0);
  const auto free = motions.free_motions(MPI_COMM_SELF);
  ASSERT_EQ(free.size(), 1u);
  EXPECT_EQ(RigidBodyMotions<2>::describe(free), "translation in y");
  const auto value = motions.value(free[0], {0.3, 0.1});
  EXPECT_NEAR(value[0], 0., 1e-12);
  EXPECT_NEAR(std::abs(value[1]), 1., 1e-12);
}

TEST(RigidBodyMotions, OneHeldPointLeavesTheRotationAboutIt)
{
  RigidBodyMotions<2> motions({0., 0.}, 1.);
  motions.hold({0.25, -0.5}, 0);
  motions.hold({0.25, -0.5}, 1);
  const auto free = motions.free_motions(MPI_COMM_SELF);
  ASSERT_EQ(free.size(), 1u);
  EXPECT_NEAR(motions.value(free[0], {0.25, -0.5}).norm(), 0., 1e-12);
  EXPECT_GT(motions.value(free[0], {0.5, 0.5}).norm(), 0.1);
  EXPECT_EQ(RigidBodyMotions<2>::describe(free), "rotation about z");
}

TEST(RigidBodyMotions, WhatIsHeldIsNotCalledFree)
{
  // A face of rollers off the centre: held along x, though turning about z moves the centre along x.
  RigidBodyMotions<3> motions({0.5, 0.5, 0.5}, 1.);
  for (const double x : {0., 1.})
    for (const double z : {0., 1.})
      motions.hold({x, 0., z}, 0);
  EXPECT_EQ(RigidBodyMotions<3>::describe(motions.free_motions(MPI_COMM_SELF)),
            "translation in y, translation in z, rotation about x, rotation about z");
}

TEST(RigidBodyMotions, ThreePointsHoldASolid)
{
  RigidBodyMotions<3> motions({0.5, 0.5, 0.5}, 1.);
  for (unsigned int d = 0; d < 3; ++d)
    motions.hold({0., 0., 0.}, d);
  motions.hold({1., 0., 0.}, 1);
  motions.hold({1., 0., 0.}, 2);
  EXPECT_EQ(motions.free_motions(MPI_COMM_SELF).size(), 1u);
  motions.hold({0., 1., 0.}, 2);
  EXPECT_TRUE(motions.free_motions(MPI_COMM_SELF).empty());
}
