// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

#include <perideal/mesh/mesh_checks.h>
#include <perideal/mesh/read_gmsh.h>

using namespace perideal;
using namespace perideal::test;

namespace
{
  template <int dim>
  void check(const std::vector<std::string> &nodes, const std::vector<std::string> &elements)
  {
    CoarseMesh<dim> mesh;
    read_gmsh(msh_22({"1 7 \"rim\""}, nodes, elements), "part.msh", mesh);
    check_coarse_mesh(mesh);
  }

  template <int dim>
  void expect_refused(const std::vector<std::string> &nodes,
                      const std::vector<std::string> &elements,
                      const std::vector<std::string> &words,
                      const int                       line = __builtin_LINE())
  {
    expect_input_error([&] { check<dim>(nodes, elements); }, words, __FILE__, line);
  }
} // namespace

TEST(MeshChecks, InvertedCellsAreMended)
{
  CoarseMesh<2> squares;
  read_gmsh(msh_22({}, two_squares, {"1 3 2 9 1 4 3 2 1", "2 3 2 9 1 2 5 6 3"}), "part.msh", squares);
  check_coarse_mesh(squares);
  EXPECT_NEAR(
    measure(squares.triangulation) / dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD), 2., 1e-14);

  CoarseMesh<3> solid;
  read_gmsh(msh_22({}, cube, {"1 5 2 9 1 5 6 7 8 1 2 3 4"}), "part.msh", solid);
  check_coarse_mesh(solid);
  EXPECT_NEAR(
    measure(solid.triangulation) / dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD), 1., 1e-14);
}

TEST(MeshChecks, RefuseBadShapes)
{
  const std::string good = "2 3 2 9 1 2 5 6 3";
  // a bow-tie without area, and one with
  expect_refused<2>(two_squares, {"1 3 2 9 1 1 2 4 3", good}, {"part.msh", "element 1 ", "Jacobian"});
  expect_refused<2>(
    {"1 0 0 0", "2 1 0 0", "3 1.5 1 0", "4 0 1 0"}, {"5 3 2 9 1 1 2 4 3"}, {"element 5 ", "Jacobian"});
  // re-entrant at (0.2, 0.2)
  expect_refused<2>({"1 0 0 0", "2 1 0 0", "3 .2 .2 0", "4 0 1 0"},
                    {"5 3 2 9 1 1 2 3 4"},
                    {"element 5 ", "not convex", "(0.2 0.2)"});
  // a corner of 180 degrees
  expect_refused<2>(
    {"1 0 0 0", "2 1 0 0", "3 .5 .5 0", "4 0 1 0"}, {"5 3 2 9 1 1 2 3 4"}, {"element 5 ", "(0.5 0.5)"});
  expect_refused<2>(
    {"1 0 0 0", "2 1 0 0", "3 2 0 0", "4 3 0 0"}, {"5 3 2 9 1 1 2 3 4"}, {"element 5 ", "no area"});
  expect_refused<2>(two_squares, {"1 3 2 9 1 1 2 3 3"}, {"element 1, ", "collapsed", "one node at two"});
  expect_refused<2>({"1 0 0 0", "2 1 0 0", "3 1 1 0", "4 1 1 0"},
                    {"1 3 2 9 1 1 2 3 4"},
                    {"element 1 ", "collapsed", "(1 1)"});
}

TEST(MeshChecks, RefuseBadShapesInSpace)
{
  const auto move = [](const int node, const std::string &position) {
    std::vector<std::string> nodes = cube;
    nodes[node - 1]                = std::to_string(node) + " " + position;
    return nodes;
  };
  const std::vector<std::string> element = {"3 5 2 9 1 1 2 3 4 5 6 7 8"};
  check<3>(move(7, "0.9 0.9 0.9"), element);
  expect_refused<3>(move(7, ".2 .2 .2"), element, {"element 3 ", "Jacobian"});
  expect_refused<3>(move(7, "1 1 0"), element, {"element 3 ", "collapsed"});
  expect_refused<3>(cube, {"3 5 2 9 1 1 2 4 3 5 6 7 8"}, {"element 3 "});
}

TEST(MeshChecks, RefuseCellsOnOneAnother)
{
  const std::string first = "1 3 2 9 1 1 2 3 4", second = "2 3 2 9 1 2 5 6 3";
  check<2>(two_squares, {first, second});
  expect_refused<2>(two_squares, {first, second, "3 3 2 8 1 1 2 3 4"}, {"lie on one another"});
  expect_refused<2>(two_squares, {first, "3 3 2 8 1 1 2 3 4"}, {"1 ", "3 ", "one another"});
  // folded back over the common edge 2 3
  std::vector<std::string> nodes = two_squares;
  nodes[4]                       = "5 0.5 0 0";
  nodes[5]                       = "6 0.5 1 0";
  expect_refused<2>(nodes, {first, second}, {"one another"});
  expect_refused<3>(
    cube, {"1 5 2 9 1 1 2 3 4 5 6 7 8", "2 5 2 8 1 1 2 3 4 5 6 7 8"}, {"one another", "two physical groups"});
}

TEST(MeshChecks, RefuseGroupsThatLoseFaces)
{
  const std::string first = "1 3 2 9 1 1 2 3 4", second = "2 3 2 9 1 2 5 6 3";
  check<2>(two_squares, {first, second, "3 1 2 7 1 1 2", "4 1 2 7 1 2 5"});
  // a diagonal, and an edge in two groups
  expect_refused<2>(two_squares, {first, second, "3 1 2 7 1 1 3"}, {"group rim has 1 faces", "of which 0"});
  expect_refused<2>(
    two_squares, {first, second, "3 1 2 7 1 1 2", "4 1 2 8 1 1 2"}, {"has 1 faces", "of which 0"});
}

TEST(MeshChecks, RefuseDoubledNodes)
{
  // two squares side by side that share no node
  std::vector<std::string> nodes = {
    "1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0", "5 1 0 0", "6 2 0 0", "7 2 1 0", "8 1 1 0"};
  const std::string first = "1 3 2 9 1 1 2 3 4", second = "2 3 2 9 1 5 6 7 8";
  expect_refused<2>(
    nodes, {first, second}, {"2 doubled nodes", "(1 0)", "Coherence;", "Coherence Mesh;", "Precracks"});
  // one at a common corner only, and to the digits that a file may have
  expect_refused<2>(
    {"1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0", "5 1.00000003 1 0", "6 2 1 0", "7 2 2 0", "8 1 2 0"},
    {first, second},
    {"1 doubled node:"});
  // two bodies with a gap, however small
  nodes[4] = "5 1.00001 0 0";
  nodes[7] = "8 1.00001 1 0";
  check<2>(nodes, {first, second});

  std::vector<std::string> solids = cube;
  for (const char *node :
       {"9 0 0 1", "10 1 0 1", "11 1 1 1", "12 0 1 1", "13 0 0 2", "14 1 0 2", "15 1 1 2", "16 0 1 2"})
    solids.push_back(node);
  expect_refused<3>(
    solids, {"1 5 2 9 1 1 2 3 4 5 6 7 8", "2 5 2 9 1 9 10 11 12 13 14 15 16"}, {"4 doubled nodes"});
}

TEST(MeshChecks, RefusePartsThatOverlap)
{
  // a square within a square, and one that lies across
  const std::vector<std::string> small  = {"5 .3 .3 0", "6 .6 .3 0", "7 .6 .6 0", "8 .3 .6 0"},
                                 across = {"5 .4 .2 0", "6 3 .2 0", "7 3 .8 0", "8 .4 .8 0"},
                                 beside = {"5 1.2 .2 0", "6 3 .2 0", "7 3 .8 0", "8 1.2 .8 0"};
  const auto with                       = [](const std::vector<std::string> &other) {
    std::vector<std::string> nodes = {"1 0 0 0", "2 1 0 0", "3 1 1 0", "4 0 1 0"};
    nodes.insert(nodes.end(), other.begin(), other.end());
    return nodes;
  };
  const std::vector<std::string> elements = {"1 3 2 9 1 1 2 3 4", "2 3 2 9 1 5 6 7 8"};
  expect_refused<2>(
    with(small),
    elements,
    {"lie on one another", "element 1 about", "in element 2 ", "2 cells in all", "Coherence;"});
  // its centre is outside, that of the other is inside
  expect_refused<2>(with(across), elements, {"lie on one another"});
  expect_refused<2>(with({"5 -1 -1 0", "6 2 -1 0", "7 2 2 0", "8 -1 2 0"}), elements, {"element 1 about"});
  check<2>(with(beside), elements);
  // boxes that overlap where the bodies do not
  check<2>(with({"5 1.2 .5 0", "6 1.5 .5 0", "7 1.5 3 0", "8 1.2 3 0"}), elements);
}

TEST(MeshChecks, NameRemediesForFoldedCells)
{
  expect_refused<2>(
    {"1 0 0 0", "2 1 0 0", "3 .2 .2 0", "4 0 1 0"},
    {"5 3 2 9 1 1 2 3 4"},
    {"SubdivisionAlgorithm", "Mesh.SecondOrderLinear = 1", "Mesh.MeshSizeMax", "transfinite"});
}
