// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/reentrant_corners.h>

#include "mesh_test.h"

#include <deal.II/grid/grid_generator.h>

using namespace perideal;
using dealii::numbers::PI;

TEST(ReentrantCorners, AreThoseOfTheCoarseMesh)
{
  Mesh<2> panel(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_L(panel.triangulation);
  panel.triangulation.refine_global(2);
  const auto corners = reentrant_corners(panel);
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_NEAR(corners[0].ends[0].norm(), 0., 1e-12);
  EXPECT_NEAR(corners[0].angle, 1.5 * PI, 1e-12);
}

TEST(ReentrantCorners, AreEdgesOfSolids)
{
  // A cube of eight of which one is missing: three edges run from its middle.
  Mesh<3> solid(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_L(solid.triangulation);
  const auto edges = reentrant_corners(solid);
  ASSERT_EQ(edges.size(), 3u);
  for (const auto &edge : edges)
    {
      EXPECT_NEAR(edge.angle, 1.5 * PI, 1e-12);
      EXPECT_NEAR(edge.ends[0].norm() * edge.ends[1].norm(), 0., 1e-12);
      EXPECT_NEAR(edge.ends[0].distance(edge.ends[1]), 1., 1e-12);
    }
}

TEST(ReentrantCorners, AreNeitherOnConvexBodiesNorInsideNorOnCurvedBoundaries)
{
  EXPECT_TRUE(reentrant_corners(*test::generate<2>("box", {3, 2})).empty());
  EXPECT_TRUE(reentrant_corners(*test::generate<3>("box", {2, 2, 1})).empty());
  // A hole of eight sides, of 225 degrees at each corner, and the same one as a circle.
  Mesh<2> ring(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_shell(ring.triangulation, dealii::Point<2>(), 0.5, 1., 8, true);
  EXPECT_EQ(reentrant_corners(ring).size(), 8u);
  ring.cylinders[0] = dealii::Point<2>();
  EXPECT_TRUE(reentrant_corners(ring).empty());
}

TEST(SingularExponent, IsThatOfWilliams)
{
  // 1 - .544484, 1 - .615731, 1 - .673583 of 270, 240 and 225 degrees.
  EXPECT_NEAR(singular_exponent(1.5 * PI), 0.455516, 1e-6);
  EXPECT_NEAR(singular_exponent(4. / 3. * PI), 0.384269, 1e-6);
  EXPECT_NEAR(singular_exponent(1.25 * PI), 0.326417, 1e-6);
  EXPECT_NEAR(singular_exponent(2. * PI), 0.5, 1e-9);
  EXPECT_NEAR(singular_exponent(PI), 0., 1e-9);
}
