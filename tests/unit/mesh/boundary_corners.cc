// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/boundary_corners.h>

#include "mesh_test.h"

#include <deal.II/grid/grid_generator.h>

#include <algorithm>

using namespace perideal;
using dealii::numbers::PI;

TEST(BoundaryCorners, OfOneBoundaryAreTheReentrantOnesOfTheCoarseMesh)
{
  Mesh<2> panel(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_L(panel.triangulation);
  panel.triangulation.refine_global(2);
  const auto corners = boundary_corners(panel);
  ASSERT_EQ(corners.size(), 1u);
  EXPECT_NEAR(corners[0].ends[0].norm(), 0., 1e-12);
  EXPECT_NEAR(corners[0].angle, 1.5 * PI, 1e-12);
  EXPECT_NEAR(corners[0].sides[0].normal * corners[0].sides[1].normal, 0., 1e-12);
}

TEST(BoundaryCorners, AreEdgesOfSolids)
{
  // A cube of eight of which one is missing: three edges run from its middle.
  Mesh<3> solid(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_L(solid.triangulation);
  const auto edges = boundary_corners(solid);
  ASSERT_EQ(edges.size(), 3u);
  for (const auto &edge : edges)
    {
      EXPECT_NEAR(edge.angle, 1.5 * PI, 1e-12);
      EXPECT_NEAR(edge.ends[0].norm() * edge.ends[1].norm(), 0., 1e-12);
      EXPECT_NEAR(edge.ends[0].distance(edge.ends[1]), 1., 1e-12);
    }
}

TEST(BoundaryCorners, AreBetweenBoundaries)
{
  const auto mesh    = test::generate<2>("box", {3, 2}, {3., 2.});
  const auto corners = boundary_corners(*mesh);
  ASSERT_EQ(corners.size(), 4u);
  for (const auto &corner : corners)
    {
      EXPECT_NEAR(corner.angle, 0.5 * PI, 1e-12);
      EXPECT_NE(corner.sides[0].boundary, corner.sides[1].boundary);
      for (const auto &side : corner.sides)
        // Out of the body, of which the middle is (1.5, 1).
        EXPECT_GT(side.normal * (corner.ends[0] - dealii::Point<2>(1.5, 1.)), 0.);
    }
  // Each edge of a block of 2 x 2 x 1 cells has as many pieces as cells along it; what is inside is none.
  const auto edges = boundary_corners(*test::generate<3>("box", {2, 2, 1}));
  EXPECT_EQ(edges.size(), 20u);
  EXPECT_FALSE(std::any_of(edges.begin(), edges.end(), [](const auto &edge) { return edge.is_reentrant(); }));
}

TEST(BoundaryCorners, AreNotOnCurvedBoundaries)
{
  // A hole of eight sides, of 225 degrees at each corner, and the same one as a circle.
  Mesh<2> ring(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_shell(ring.triangulation, dealii::Point<2>(), 0.5, 1., 8, true);
  EXPECT_EQ(boundary_corners(ring).size(), 8u);
  ring.cylinders[0] = dealii::Point<2>();
  EXPECT_TRUE(boundary_corners(ring).empty());
}
