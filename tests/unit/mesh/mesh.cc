// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

using namespace perideal;
using namespace perideal::test;

namespace
{
  /// Two squares of different groups; the left edge is named, the right numbered, the rest neither.
  std::unique_ptr<Mesh<2>> two_groups()
  {
    const TemporaryDirectory directory;
    return read<2>(
      directory.write("mesh.msh",
                      msh_22({"1 7 \"left edge\"", "1 8 \"empty\"", "2 3 \"steel\""},
                             two_squares,
                             {"1 1 2 7 1 4 1", "2 1 2 9 1 5 6", "3 3 2 3 1 1 2 3 4", "4 3 2 4 1 2 5 6 3"})));
  }
} // namespace

TEST(Mesh, FindsBoundariesByNameAndNumber)
{
  const auto mesh = two_groups();
  EXPECT_EQ(mesh->boundary_id("left edge", "p"), 7u);
  EXPECT_EQ(mesh->boundary_id("7", "p"), 7u);
  EXPECT_EQ(mesh->boundary_id("9", "p"), 9u);
  EXPECT_EQ(mesh->boundary_id("0", "p"), 0u);
  EXPECT_EQ(mesh->boundary_name(7), "left edge");
  EXPECT_EQ(mesh->boundary_name(9), "9");
  EXPECT_EQ(mesh->boundary_ids, (std::set<dealii::types::boundary_id>{0, 7, 9}));
}

TEST(Mesh, ListsTheBoundariesItHas)
{
  const auto mesh = two_groups();
  expect_input_error(
    [&] { mesh->boundary_id("left egde", "Boundary conditions/a/Boundary"); },
    {"Boundary conditions/a/Boundary", "left egde", "0 | left edge | 9", "did you mean: left edge"});
  for (const char *wrong : {"empty", "8", "-7", "7x", ""})
    expect_input_error([&] { mesh->boundary_id(wrong, "p"); }, {"no boundary"});
}

TEST(Mesh, FindsCellGroups)
{
  const auto mesh = two_groups();
  EXPECT_EQ(mesh->material_id("steel", "p"), 3u);
  EXPECT_EQ(mesh->material_id("4", "p"), 4u);
  expect_input_error([&] { mesh->material_id("left edge", "Material/left edge"); },
                     {"Material/left edge", "group of cells", "steel | 4"});
}

TEST(Mesh, KeepsThicknessInThePlaneOnly)
{
  MeshParameters parameters;
  parameters.generator = "box";
  parameters.cells     = {1, 1};
  parameters.thickness = 0.25;
  EXPECT_EQ(create_mesh<2>(parameters, MPI_COMM_WORLD, "")->thickness, 0.25);
  parameters.cells = {1, 1, 1};
  EXPECT_EQ(create_mesh<3>(parameters, MPI_COMM_WORLD, "")->thickness, 1.);
}
