// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

using namespace perideal;
using namespace perideal::test;

TEST(MeshParameters, ReadsItsSection)
{
  dealii::ParameterHandler handler;
  MeshParameters           parameters;
  parameters.declare(handler);
  handler.parse_input_from_string("subsection Mesh\n"
                                  "set File = meshes/a mesh.msh\n"
                                  "set Cells = 30, 32\n"
                                  "set Size = 1.5\n"
                                  "set Hole radius = 0.2\n"
                                  "set Grading = 3\n"
                                  "set Refinements = 2\n"
                                  "set Thickness = 0.01\n"
                                  "set Cylinders = hole: 0, -0.5; pin one: 1, 2e-1\n"
                                  "end\n");
  EXPECT_EQ(parameters.file, "meshes/a mesh.msh");
  EXPECT_EQ(parameters.cells, (std::vector<unsigned int>{30, 32}));
  EXPECT_EQ(parameters.size, std::vector<double>{1.5});
  EXPECT_EQ(parameters.hole_radius, 0.2);
  EXPECT_EQ(parameters.grading, 3.);
  EXPECT_EQ(parameters.refinements, 2u);
  EXPECT_EQ(parameters.thickness, 0.01);
  ASSERT_EQ(parameters.cylinders.size(), 2u);
  EXPECT_EQ(parameters.cylinders.at("hole"), dealii::Point<2>(0., -0.5));
  EXPECT_EQ(parameters.cylinders.at("pin one"), dealii::Point<2>(1., 0.2));
}

TEST(MeshParameters, DefaultsAreEmptyOrGood)
{
  dealii::ParameterHandler handler;
  MeshParameters           parameters;
  parameters.declare(handler);
  handler.parse_input_from_string("subsection Mesh\nset Generator = box\nend\n");
  parameters.check();
  EXPECT_TRUE(parameters.cells.empty());
  EXPECT_TRUE(parameters.size.empty());
  EXPECT_TRUE(parameters.cylinders.empty());
}

TEST(MeshParameters, AsksForOneMesh)
{
  MeshParameters parameters;
  expect_input_error([&] { parameters.check(); },
                     {"give Mesh/File or Mesh/Generator", "box | plate with hole"});
  parameters.file      = "a.msh";
  parameters.generator = "box";
  expect_input_error([&] { parameters.check(); }, {"Mesh/File", "two meshes", "a.msh"});
  parameters.file.clear();
  parameters.thickness = 0.;
  expect_input_error([&] { parameters.check(); }, {"Mesh/Thickness", ">= 1e-12"});
  parameters.thickness         = 1.;
  parameters.cylinders["hole"] = {};
  expect_input_error([&] { parameters.check(); }, {"Mesh/Cylinders"});
}
