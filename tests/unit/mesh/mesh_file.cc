// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

#include <perideal/mesh/mesh_file.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>

using namespace perideal;
using namespace perideal::test;

namespace
{
  /// Two transfinite rectangles; without groups, unless the rest names some.
  const std::string rectangles =
    "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0};\n"
    "Point(4) = {0, 1, 0}; Point(5) = {2, 0, 0}; Point(6) = {2, 1, 0};\n"
    "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
    "Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3};\n"
    "Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
    "Curve Loop(2) = {5, 6, 7, -2}; Plane Surface(2) = {2};\n"
    "Transfinite Curve \"*\" = 3; Transfinite Surface \"*\"; Recombine Surface \"*\";\n";
  const std::string groups = "Physical Curve(\"left\", 1) = {-4}; Physical Surface(\"body\", 2) = {1, 2};\n";
} // namespace

TEST(MeshFile, IsFoundBesideTheScene)
{
  const TemporaryDirectory directory;
  directory.write("square.msh", msh_22({}, two_squares, {"1 3 2 1 1 1 2 3 4"}));
  MeshParameters parameters;
  parameters.file = "square.msh";
  EXPECT_NEAR(
    measure(create_mesh<2>(parameters, MPI_COMM_WORLD, directory.path())->triangulation), 1., 1e-14);

  parameters.file = "sqaure.msh";
  expect_input_error([&] { create_mesh<2>(parameters, MPI_COMM_WORLD, directory.path()); },
                     {"Mesh/File", "no such mesh file", directory.path(), "did you mean: square.msh"});
  expect_input_error([&] { read<2>(directory.write("mesh.stl", "text")); },
                     {"Mesh/File", ".msh | .geo | .inp", "meshio convert mesh.stl"});
}

TEST(MeshFile, GeometryIsMeshedByGmsh)
{
  const TemporaryDirectory directory;
  const auto               mesh = read<2>(directory.write("rectangles.geo", rectangles + groups));
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 8u);
  // Gmsh places vertices to 1e-12
  EXPECT_NEAR(measure(mesh->triangulation), 2., 1e-10);
  EXPECT_NEAR(boundary_measure(*mesh, "left"), 1., 1e-10) << "a reversed curve keeps its group";
}

/// Gmsh then saves the curve between the rectangles too, which means nothing.
TEST(MeshFile, GeometryNeedsNoGroups)
{
  const TemporaryDirectory directory;
  const auto               mesh = read<2>(directory.write("no_groups.geo", rectangles));
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 8u);
  EXPECT_TRUE(mesh->inner_faces.empty());
}

TEST(MeshFile, GeometryErrorsAreGmshsOwn)
{
  const TemporaryDirectory directory;
  expect_input_error([&] { read<2>(directory.write("bad.geo", "Point(1) = {0, 0, 0};\nFoo bar;\n")); },
                     {"Mesh/File", "bad.geo", "gmsh failed", "line 2"});
  expect_input_error([&] { read<3>(directory.write("flat.geo", rectangles + groups)); }, {"Dimension = 2"});
}

TEST(MeshFile, SaysWhenGmshIsMissing)
{
  const TemporaryDirectory directory;
  const std::string        file = directory.write("rectangles.geo", rectangles + groups);
  const char              *path = std::getenv("PATH");
  const std::string        old  = path == nullptr ? "" : path;
  setenv("PATH", directory.path().c_str(), 1);
  expect_input_error([&] { read<2>(file); }, {"Mesh/File", "gmsh", "apt-get install gmsh"});
  setenv("PATH", old.c_str(), 1);
}

TEST(MeshFile, BundledMeshesRead)
{
  const auto plate = read<2>("meshes/plate_unstructured.msh");
  EXPECT_EQ(plate->triangulation.n_global_active_cells(), 2444u);
  EXPECT_EQ(plate->description, "meshes/plate_unstructured.msh, 2,444 quads");
  // Gmsh has 64 edges around the hole and places vertices to 1e-12
  EXPECT_NEAR(measure(plate->triangulation), plate_area(64), 1e-9);
  EXPECT_NEAR(boundary_measure(*plate, "right"), 1., 1e-10);

  const auto block = read<3>("meshes/block.msh");
  EXPECT_EQ(block->triangulation.n_global_active_cells(), 150u);
  EXPECT_NEAR(measure(block->triangulation), 2., 1e-10);
  EXPECT_NEAR(boundary_measure(*block, "left"), 1., 1e-10);
  EXPECT_NEAR(boundary_measure(*block, "top"), 2., 1e-10);
  EXPECT_EQ(block->material_id("block", "p"), 7u);
}

TEST(MeshFile, BundledGeometryIsTheGeneratorsPlate)
{
  const auto file      = read<2>("meshes/plate_with_hole.geo"),
             generated = generate<2>("plate with hole", {30, 32});
  EXPECT_EQ(file->triangulation.n_global_active_cells(), 7680u);
  EXPECT_NEAR(measure(file->triangulation), measure(generated->triangulation), 1e-9);
  for (const char *side : {"left", "right", "bottom", "top", "hole"})
    EXPECT_NEAR(boundary_measure(*file, side), boundary_measure(*generated, side), 1e-9) << side;
}

TEST(MeshFile, BundledLaminateHasItsSize)
{
  const auto mesh = read<2>("meshes/laminate_with_hole.geo");
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 7440u);
  // The hole is a polygon of 120 corners; coordinates have 16 digits in the file.
  const double angle = 2 * dealii::numbers::PI / 120;
  EXPECT_NEAR(measure(mesh->triangulation), 0.15 * 0.05 - 60 * 1e-4 * std::sin(angle), 1e-12);
  EXPECT_NEAR(boundary_measure(*mesh, "hole"), 120 * 0.02 * std::sin(angle / 2), 1e-12);
  for (const char *side : {"left", "right"})
    EXPECT_NEAR(boundary_measure(*mesh, side), 0.05, 1e-12) << side;
  for (const char *side : {"bottom", "top"})
    EXPECT_NEAR(boundary_measure(*mesh, side), 0.15, 1e-12) << side;
}

TEST(MeshFile, NamesOfGeometriesAreNoOptions)
{
  const TemporaryDirectory directory;
  directory.write("-2.geo", rectangles + groups);
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(directory.path());
  MeshParameters parameters;
  parameters.file = "-2.geo";
  EXPECT_EQ(create_mesh<2>(parameters, MPI_COMM_WORLD, "")->triangulation.n_global_active_cells(), 8u);
  std::filesystem::current_path(before);
}

TEST(MeshFile, EndsGmshWhenTheTimeIsOver)
{
  const TemporaryDirectory directory;
  const std::string        file = directory.write("rectangles.geo", rectangles + groups);
  const std::string        gmsh = directory.write("gmsh", "#!/bin/sh\nexec sleep 100\n");
  std::filesystem::permissions(gmsh, std::filesystem::perms::owner_all);
  const char       *path = std::getenv("PATH");
  const std::string old  = path == nullptr ? "" : path;
  setenv("PATH", (directory.path() + ":" + old).c_str(), 1);
  MeshParameters parameters;
  parameters.file            = file;
  parameters.gmsh_time_limit = 0.3;
  expect_input_error([&] { create_mesh<2>(parameters, MPI_COMM_WORLD, ""); },
                     {"Mesh/File", "rectangles.geo", "within 0.3 s", "Mesh/Gmsh time limit"});
  setenv("PATH", old.c_str(), 1);
}

TEST(MeshFile, CoordinatesAreScaled)
{
  const TemporaryDirectory directory;
  MeshParameters           parameters;
  parameters.file  = directory.write("rectangles.geo", rectangles + groups);
  parameters.scale = 0.001;
  const auto mesh  = create_mesh<2>(parameters, MPI_COMM_WORLD, "");
  EXPECT_NEAR(measure(mesh->triangulation), 2e-6, 1e-16);
  EXPECT_NEAR(boundary_measure(*mesh, "left"), 1e-3, 1e-13);
  parameters.scale = 0;
  expect_input_error([&] { create_mesh<2>(parameters, MPI_COMM_WORLD, ""); }, {"Mesh/Scale", "positive"});
}
