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
