// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace perideal;
using namespace perideal::test;

TEST(Box, HasItsSizeAndSides)
{
  const auto mesh = generate<2>("box", {4, 3}, {2., 0.5});
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 12u);
  // sums of a few products of doubles
  EXPECT_NEAR(measure(mesh->triangulation), 1., 1e-14);
  EXPECT_NEAR(boundary_measure(*mesh, "left"), 0.5, 1e-14);
  EXPECT_NEAR(boundary_measure(*mesh, "right"), 0.5, 1e-14);
  EXPECT_NEAR(boundary_measure(*mesh, "bottom"), 2., 1e-14);
  EXPECT_NEAR(boundary_measure(*mesh, "top"), 2., 1e-14);
  EXPECT_EQ(mesh->description, "box, 12 quads");
}

TEST(Box, NamesTheSidesInSpace)
{
  const auto mesh = generate<3>("box", {2, 1, 3}, {2., 3., 5.}, 1);
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 48u);
  EXPECT_NEAR(measure(mesh->triangulation), 30., 1e-12);
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          {
            const std::string name = mesh->boundary_name(face->boundary_id());
            const auto        x    = face->center();
            EXPECT_TRUE((name == "left" && x[0] == 0.) || (name == "right" && x[0] == 2.) ||
                        (name == "bottom" && x[1] == 0.) || (name == "top" && x[1] == 3.) ||
                        (name == "back" && x[2] == 0.) || (name == "front" && x[2] == 5.))
              << name << " at " << x;
          }
}

TEST(PlateWithHole, HasTheCellsAndAreaOfItsPolygon)
{
  const auto mesh = generate<2>("plate with hole", {30, 32});
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 7680u);
  EXPECT_EQ(mesh->description, "plate with hole, 7,680 quads");
  // round-off of 7680 summands
  EXPECT_NEAR(measure(mesh->triangulation), plate_area(240), 1e-13);
  for (const char *side : {"left", "right", "bottom", "top"})
    EXPECT_NEAR(boundary_measure(*mesh, side), 1., 1e-13) << side;
  EXPECT_NEAR(boundary_measure(*mesh, "hole"), 240 * 0.2 * std::sin(dealii::numbers::PI / 240), 1e-13);
}

TEST(PlateWithHole, DefaultsToTheCellsOfThePaper)
{
  EXPECT_EQ(generate<2>("plate with hole", {})->triangulation.n_global_active_cells(), 7680u);
}

TEST(PlateWithHole, RefinementFollowsTheCircle)
{
  for (unsigned int refinements = 0; refinements < 4; ++refinements)
    {
      const auto mesh = generate<2>("plate with hole", {2, 2}, {}, refinements);
      EXPECT_NEAR(measure(mesh->triangulation), plate_area(16u << refinements), 1e-13);
    }
}

TEST(PlateWithHole, GradesGeometrically)
{
  MeshParameters parameters;
  parameters.generator = "plate with hole";
  parameters.cells     = {1, 4};
  parameters.grading   = 16.;
  const auto mesh      = create_mesh<2>(parameters, MPI_COMM_WORLD, "");
  // along the x axis the cells grow by 16^(1/4) = 2: 1 + 2 + 4 + 8 = 15 parts of 0.4
  std::set<double> on_axis;
  for (const auto &vertex : mesh->triangulation.get_vertices())
    if (vertex[1] == 0. && vertex[0] > 0)
      on_axis.insert(vertex[0]);
  ASSERT_EQ(on_axis.size(), 5u);
  auto x = on_axis.begin();
  for (const double part : {0., 1., 3., 7., 15.})
    EXPECT_NEAR(*x++, 0.1 + 0.4 * part / 15, 1e-15);
}

TEST(PlateWithHole, IsSymmetricToTheLastBit)
{
  const auto                          mesh = generate<2>("plate with hole", {7, 5});
  std::set<std::pair<double, double>> vertices;
  for (const auto &x : mesh->triangulation.get_vertices())
    vertices.emplace(x[0], x[1]);
  EXPECT_EQ(vertices.size(), 8u * 7 * 6) << "vertices are made once";
  for (const auto &[x, y] : vertices)
    {
      EXPECT_EQ(vertices.count({-x, y}), 1u) << x << " " << y;
      EXPECT_EQ(vertices.count({x, -y}), 1u) << x << " " << y;
      EXPECT_EQ(vertices.count({y, x}), 1u) << x << " " << y;
    }
}

TEST(PlateWithHole, ExtrudesAboutTheOrigin)
{
  const auto mesh = generate<3>("plate with hole", {3, 2, 2}, {1., 0.2}, 1);
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 8u * 3 * 2 * 2 * 8);
  EXPECT_NEAR(measure(mesh->triangulation), 0.2 * plate_area(48), 1e-13);
  EXPECT_NEAR(boundary_measure(*mesh, "hole"), 0.2 * 48 * 0.2 * std::sin(dealii::numbers::PI / 48), 1e-13);
  for (const char *side : {"back", "front"})
    EXPECT_NEAR(boundary_measure(*mesh, side), plate_area(48), 1e-13) << side;
  for (const auto &vertex : mesh->triangulation.get_vertices())
    EXPECT_LE(std::abs(vertex[2]), 0.1 + 1e-15);
}

TEST(PlateWithHoleGrid, LeavesOutTheCellsInTheHole)
{
  MeshParameters parameters;
  parameters.generator   = "plate with hole grid";
  parameters.cells       = {150, 50};
  parameters.size        = {0.15, 0.05};
  parameters.hole_radius = 0.01;
  const auto mesh        = create_mesh<2>(parameters, MPI_COMM_WORLD, "");
  // Half-integers a, b with a^2 + b^2 <= 100 are 316.
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 7184u);
  EXPECT_EQ(mesh->description, "plate with hole grid, 7,184 quads");
  EXPECT_NEAR(measure(mesh->triangulation), 7184e-6, 1e-15);
  for (const char *side : {"left", "right"})
    EXPECT_NEAR(boundary_measure(*mesh, side), 0.05, 1e-14) << side;
  for (const char *side : {"bottom", "top"})
    EXPECT_NEAR(boundary_measure(*mesh, side), 0.15, 1e-14) << side;
  // A convex hole in steps is as long as the square around it.
  EXPECT_NEAR(boundary_measure(*mesh, "hole"), 0.08, 1e-14);
}

TEST(PlateWithHoleGrid, FillsSpace)
{
  const auto mesh = generate<3>("plate with hole grid", {10, 10, 2}, {1., 1., 0.2}, 1);
  // Four columns of two cells have their axis within 0.1 of the origin.
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), (10u * 10 * 2 - 4 * 2) * 8);
  EXPECT_NEAR(boundary_measure(*mesh, "hole"), 4 * 0.2 * 0.2, 1e-14);
  for (const char *side : {"back", "front"})
    EXPECT_NEAR(boundary_measure(*mesh, side), 0.96, 1e-13) << side;
}

TEST(Generators, RefuseWhatDoesNotFit)
{
  expect_input_error(
    [] {
      generate<2>("plate with hole grid", {4, 4});
    },
    {"Mesh/Hole radius", "must take cells", "0.17"});
  expect_input_error(
    [] {
      generate<2>("plate with hole grid", {4, 4}, {0.2, 1.});
    },
    {"Mesh/Hole radius", "none at the edges"});
  expect_input_error([] { generate<2>("plate with hoel", {}); },
                     {"Mesh/Generator",
                      "plate with hoel",
                      "box | plate with hole | plate with hole grid",
                      "did you mean: plate with hole"});
  expect_input_error([] { generate<2>("box", {1, 2, 3}); }, {"Mesh/Cells", "2 numbers", "counts along x, y"});
  expect_input_error([] { generate<3>("plate with hole", {}, {1.}); }, {"Mesh/Size", "depth"});
  expect_input_error([] { generate<2>("box", {}, {1., 0.}); }, {"Mesh/Size", "positive"});
  expect_input_error([] { generate<2>("plate with hole", {}, {0.2}); },
                     {"Mesh/Hole radius", "half the side"});
  expect_input_error([] { generate<2>("box", {100000, 100000}); }, {"Mesh/Cells", "Mesh/Refinements"});
  expect_input_error([] { generate<3>("box", {}, {}, 15); }, {"Mesh/Refinements"});
}
