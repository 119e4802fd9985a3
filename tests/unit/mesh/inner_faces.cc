// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"
#include "msh_box.h"

#include <perideal/mesh/read_gmsh.h>

using namespace perideal;
using namespace perideal::test;

namespace
{
  const std::vector<std::string> names_2 = {"1 7 \"rim\"", "1 8 \"crack\"", "2 100 \"body\""};
  const std::vector<std::string> names_3 = {"2 7 \"rim\"", "2 8 \"crack\"", "3 100 \"body\""};

  /// The left half of the middle line or plane across the last axis is the crack, the outside the rim.
  template <int dim>
  int half_plane(const dealii::Point<dim> &centre, const bool is_inner)
  {
    if (!is_inner)
      return 7;
    return centre[dim - 1] == 0.5 && centre[0] < 0.5 ? 8 : -1;
  }

  /// The rim, and it alone, bounds the body.
  template <int dim>
  void expect_rim(const CoarseMesh<dim> &mesh)
  {
    unsigned int n_faces = 0;
    for (const auto &face : mesh.triangulation.active_face_iterators())
      if (face->at_boundary())
        {
          EXPECT_EQ(face->boundary_id(), 7u);
          ++n_faces;
        }
    EXPECT_EQ(mesh.faces_in_file.at(7), n_faces);
    EXPECT_EQ(mesh.faces_in_file.size(), 1u);
    EXPECT_EQ(mesh.boundary_names.size(), 1u);
  }

  template <int dim>
  void expect_half_plane(const std::vector<std::string> &names)
  {
    CoarseMesh<dim> mesh;
    read_gmsh(msh_box<dim>(4, names, half_plane<dim>), "part.msh", mesh);
    expect_rim(mesh);
    const auto &crack = mesh.inner_faces.at("crack");
    ASSERT_EQ(crack.size(), dim == 2 ? 2u : 8u);
    for (const auto &face : crack)
      {
        ASSERT_EQ(face.size(), dim == 2 ? 2u : 4u);
        for (std::size_t k = 0; k < face.size(); ++k)
          {
            EXPECT_EQ(face[k][dim - 1], 0.5);
            EXPECT_LE(face[k][0], 0.5);
            // Around the face: every step is a side.
            EXPECT_NEAR(face[k].distance(face[(k + 1) % face.size()]), 0.25, 1e-15);
          }
      }
  }

  /// Two squares and the line between them in format 4.1, in a group of its own.
  const std::string squares_41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n3\n1 7 \"left\"\n1 8 \"middle\"\n2 9 \"body\"\n$EndPhysicalNames\n"
    "$Entities\n0 2 1 0\n"
    "4 0 0 0 0 1 0 1 7 0 \n"
    "5 1 0 0 1 1 0 1 8 0 \n"
    "1 0 0 0 2 1 0 1 9 0 \n$EndEntities\n"
    "$Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\n$EndNodes\n"
    "$Elements\n3 4 1 4\n1 4 1 1\n1 4 1 \n1 5 1 1\n2 2 3 \n2 1 3 2\n3 1 2 3 4 \n4 2 5 6 3 \n$EndElements\n";
} // namespace

TEST(InnerFaces, AreKeptApartFromTheBoundary)
{
  expect_half_plane<2>(names_2);
  expect_half_plane<3>(names_3);
}

TEST(InnerFaces, AreReadFromTheNewFormat)
{
  CoarseMesh<2> mesh;
  read_gmsh(squares_41, "part.msh", mesh);
  EXPECT_EQ(mesh.triangulation.n_active_cells(), 2u);
  const InnerFaces<2> expected = {{"middle", {{dealii::Point<2>(1, 0), dealii::Point<2>(1, 1)}}}};
  EXPECT_EQ(mesh.inner_faces, expected);
  EXPECT_EQ(mesh.faces_in_file.at(7), 1u);
  EXPECT_EQ(mesh.faces_in_file.count(8), 0u);
}

/// Without a group of the body Gmsh saves all curves: those inside mean nothing.
TEST(InnerFaces, InNoGroupAreLeftOut)
{
  CoarseMesh<2> mesh;
  read_gmsh(msh_box<2>(3, {"2 100 \"body\""}, [](const dealii::Point<2> &, const bool) { return 0; }),
            "part.msh",
            mesh);
  EXPECT_EQ(mesh.triangulation.n_active_cells(), 9u);
  EXPECT_TRUE(mesh.inner_faces.empty());
}

TEST(InnerFaces, OfAGroupThatBoundsTheBodyTooAreAnError)
{
  CoarseMesh<2> mesh;
  expect_input_error(
    [&] {
      read_gmsh(msh_box<2>(4,
                           names_2,
                           [](const dealii::Point<2> &centre, const bool) {
                             return centre[1] == 0.5 || centre[0] == 0. ? 8 : -1;
                           }),
                "part.msh",
                mesh);
    },
    {"part.msh", "curve crack", "4 faces lie inside", "4 on its surface", "two groups"});
}

/// A curve inside a three-dimensional body is neither boundary nor faces.
TEST(InnerFaces, AreNoCurvesOfThreeDimensionalBodies)
{
  std::string       text   = msh_box<3>(2, names_3, [](const dealii::Point<3> &, const bool) { return -1; });
  const std::string before = "$Elements\n8\n", after = "$Elements\n9\n9 1 2 7 7 5 14\n";
  text.replace(text.find(before), before.size(), after);
  CoarseMesh<3> mesh;
  expect_input_error([&] { read_gmsh(text, "part.msh", mesh); },
                     {"part.msh", "curves inside a three-dimensional body"});
}

TEST(InnerFaces, UnknownNamesAreErrors)
{
  const TemporaryDirectory directory;
  const auto               mesh = read<2>(directory.write("box.msh", msh_box<2>(4, names_2, half_plane<2>)));
  EXPECT_EQ(mesh->inner_group("crack", "Precracks/c/Boundary").size(), 2u);
  expect_input_error([&] { mesh->inner_group("crak", "Precracks/c/Boundary"); },
                     {"Precracks/c/Boundary", "crak", "allowed:", "did you mean:", "crack"});
  expect_input_error([&] { mesh->inner_group("rim", "Precracks/c/Boundary"); },
                     {"Precracks/c/Boundary", "rim", "bounds the body"});
  const auto plain = generate<2>("box", {2, 2});
  expect_input_error([&] { plain->inner_group("crack", "Precracks/c/Boundary"); },
                     {"Precracks/c/Boundary", "crack", "none"});
}
