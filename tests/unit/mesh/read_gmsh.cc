// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

#include <perideal/mesh/read_gmsh.h>

using namespace perideal;
using namespace perideal::test;

namespace
{
  const std::vector<std::string> names = {"1 7 \"left\"", "2 9 \"body\""};
  const std::vector<std::string> quads = {"1 1 2 7 4 4 1", "2 3 2 9 1 1 2 3 4", "3 3 2 9 1 2 5 6 3"};

  /// The mesh of names, two_squares and quads as Gmsh writes it in format 4.1.
  const std::string squares_41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n2\n1 7 \"left\"\n2 9 \"body\"\n$EndPhysicalNames\n"
    "$Entities\n1 1 1 0\n"
    "1 0 0 0 0 \n"
    "4 0 0 0 0 1 0 1 7 2 4 -1 \n"
    "1 0 0 0 2 1 0 1 9 1 4 \n$EndEntities\n"
    "$Nodes\n2 6 1 6\n1 4 0 2\n1\n4\n0 0 0\n0 1 0\n"
    "2 1 0 4\n2\n3\n5\n6\n1 0 0\n1 1 0\n2 0 0\n2 1 0\n$EndNodes\n"
    "$Elements\n2 3 1 3\n1 4 1 1\n1 4 1 \n2 1 3 2\n2 1 2 3 4 \n3 2 5 6 3 \n$EndElements\n";

  template <int dim>
  void read_text(const std::string &text)
  {
    CoarseMesh<dim> mesh;
    read_gmsh(text, "part.msh", mesh);
  }
} // namespace

TEST(ReadGmsh, BothFormatsGiveTheSameMesh)
{
  CoarseMesh<2> old_format, new_format;
  read_gmsh(msh_22(names, two_squares, quads), "22", old_format);
  read_gmsh(squares_41, "41", new_format);
  for (const CoarseMesh<2> *mesh : {&old_format, &new_format})
    {
      EXPECT_EQ(mesh->boundary_names.at("left"), 7u);
      EXPECT_EQ(mesh->material_names.at("body"), 9u);
      EXPECT_EQ(mesh->element_numbers, (std::vector<std::uint64_t>{2, 3}));
      EXPECT_EQ(mesh->faces_in_file.at(7), 1u);
      ASSERT_EQ(mesh->triangulation.n_active_cells(), 2u);
      for (const auto &cell : mesh->triangulation.active_cell_iterators())
        {
          EXPECT_EQ(cell->material_id(), 9u);
          EXPECT_EQ(cell->center(), dealii::Point<2>(cell->index() + 0.5, 0.5));
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              {
                EXPECT_EQ(face->boundary_id(), face->center()[0] == 0. ? 7u : 0u);
              }
        }
    }
}

TEST(ReadGmsh, WindowsLinesAndHeightDoNotMatter)
{
  std::string text = msh_22(names, {"1 0 0 5", "2 1 0 5", "3 1 1 5", "4 0 1 5", "5 2 0 5", "6 2 1 5"}, quads);
  for (std::size_t i = 0; (i = text.find('\n', i)) != std::string::npos; i += 2)
    text.insert(i, "\r");
  CoarseMesh<2> mesh;
  read_gmsh(text, "part.msh", mesh);
  EXPECT_EQ(mesh.triangulation.n_active_cells(), 2u);
  EXPECT_EQ(mesh.boundary_names.count("left"), 1u);
}

TEST(ReadGmsh, RefusesWhatIsNoMesh)
{
  const std::string good = msh_22(names, two_squares, quads);
  expect_input_error([] { read_text<2>(""); }, {"part.msh", "Mesh/File", "empty"});
  expect_input_error([] { read_text<2>("\n  \n"); }, {"empty"});
  expect_input_error([] { read_text<2>("solid garbage"); }, {"part.msh:1", "not a Gmsh mesh"});
  expect_input_error([] { read_text<2>("$NOD\n1\n"); }, {"format 1", "gmsh OLD.msh"});
  expect_input_error([] { read_text<2>("$MeshFormat\n4.1 1 8\n"); },
                     {"part.msh:2", "binary", "Mesh.Binary = 0"});
  expect_input_error([] { read_text<2>("$MeshFormat\n4 0 8\n$EndMeshFormat\n"); }, {"2.2 and 4.1"});
  expect_input_error([] { read_text<2>("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"); }, {"no section $Nodes"});
  expect_input_error([&] { read_text<2>(good + "garbage\n"); }, {"beginning of a section", "garbage"});
}

TEST(ReadGmsh, RefusesTruncatedFilesWhereverTheyEnd)
{
  for (const std::string &text : {msh_22(names, two_squares, quads), squares_41})
    // the last character is the line end behind $EndElements
    for (std::size_t length = 0; length + 1 < text.size(); ++length)
      expect_input_error([&] { read_text<2>(text.substr(0, length)); }, {"Mesh/File"});
}

TEST(ReadGmsh, RefusesOtherElements)
{
  const auto with = [](const std::string &element) { return msh_22({}, two_squares, {quads[1], element}); };
  expect_input_error([&] { read_text<2>(with("7 2 2 9 1 2 5 6")); },
                     {"part.msh", "element 7 is a triangle", "Mesh.RecombineAll = 1"});
  expect_input_error([&] { read_text<2>(with("8 10 2 9 1 1 2 3 4 5 6 7 8 9")); },
                     {"element 8 is a second-order quadrilateral", "Mesh.ElementOrder = 1"});
  expect_input_error([&] { read_text<2>(with("9 36 2 9 1 1 2 3 4")); },
                     {"element 9", "type 36", "ElementOrder"});
  for (const char *prism : {"7 6 2 9 1 1 2 3 5 6 7", "7 4 2 9 1 1 2 3 5"})
    expect_input_error([&] { read_text<3>(msh_22({}, cube, {prism})); },
                       {"element 7", "hexahedra", "Recombine"});
}

TEST(ReadGmsh, RefusesTheWrongDimension)
{
  const std::string solid = msh_22({}, cube, {"1 5 2 9 1 1 2 3 4 5 6 7 8"});
  const std::string plane = msh_22({}, two_squares, {quads[1]});
  read_text<3>(solid);
  read_text<2>(plane);
  expect_input_error([&] { read_text<2>(solid); }, {"three-dimensional", "set Dimension = 3"});
  expect_input_error([&] { read_text<3>(plane); }, {"two-dimensional", "set Dimension = 2"});
  expect_input_error([&] { read_text<2>(msh_22({}, two_squares, {quads[0]})); },
                     {"no quadrilaterals", "groups"});
  expect_input_error([&] { read_text<2>(msh_22({}, cube, {"1 3 2 9 1 1 2 7 8"})); }, {"planar"});
}

TEST(ReadGmsh, RefusesWrongNumbers)
{
  expect_input_error([] { read_text<2>(msh_22({}, two_squares, {"2 3 2 9 1 1 2 3"})); },
                     {"element 2", "4 node"});
  expect_input_error([] { read_text<2>(msh_22({}, two_squares, {"2 3 2 9 1 1 2 3 4 5"})); }, {"element 2"});
  expect_input_error([] { read_text<2>(msh_22({}, two_squares, {"2 3 2 9 1 1 2 3 44"})); },
                     {"element 2", "node 44", "$Nodes"});
  expect_input_error([] { read_text<2>(msh_22({}, two_squares, {"2 3 2 -9 1 1 2 3 4"})); }, {"negative"});
  expect_input_error([] { read_text<2>(msh_22({}, {"1 0 nan 0"}, {})); }, {"$Nodes", "1 0 nan 0"});
  expect_input_error([] { read_text<2>(msh_22({}, {"1 0 0,5 0"}, {})); }, {"$Nodes", "1 0 0,5 0"});
}

TEST(ReadGmsh, RefusesEntitiesDealiiMisreads)
{
  const auto replace = [](const std::string &from, const std::string &to) {
    std::string text = squares_41;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_input_error([&] { read_text<2>(replace("1 7 2 4 -1", "2 7 8 2 4 -1")); },
                     {"curve 4", "more than one physical group"});
  expect_input_error([&] { read_text<2>(replace("1 7 2 4 -1", "1 -7 2 4 -1")); }, {"curve 4", "negative"});
  expect_input_error([&] { read_text<2>(replace("$Entities", "$PartitionedEntities")); }, {"partitioned"});
}

TEST(ReadGmsh, TakesEdgesAndCornersOfTheSurface)
{
  std::vector<std::string> nodes = cube;
  nodes.insert(nodes.end(), {"9 0 0 2", "10 1 0 2", "11 1 1 2", "12 0 1 2"});
  const std::string lower = "1 5 2 9 1 1 2 3 4 5 6 7 8", upper = "2 5 2 9 1 5 6 7 8 9 10 11 12";
  read_text<3>(msh_22({}, nodes, {lower, upper, "3 3 2 7 1 1 2 3 4", "4 1 2 8 1 1 2", "5 15 2 3 1 1"}));
}

TEST(ReadGmsh, RefusesElementsListedTwice)
{
  // deal.II does not come back from these
  for (const char *again :
       {"3 3 2 9 1 1 2 3 4", "4 3 2 9 1 1 2 3 4", "4 3 2 9 1 3 4 1 2", "4 3 2 9 1 4 3 2 1"})
    expect_input_error(
      [&] {
        read_text<2>(msh_22({}, two_squares, {quads[1], quads[2], again}));
      },
      {"part.msh:17", "elements 2 (line 15) and ", "same nodes"});
  expect_input_error(
    [] {
      read_text<3>(msh_22({}, cube, {"1 5 2 9 1 1 2 3 4 5 6 7 8", "2 5 2 9 1 5 6 7 8 1 2 3 4"}));
    },
    {"elements 1 (line 17) and 2", "same nodes", "two physical groups"});
}

TEST(ReadGmsh, RefusesNodesThatAreMissingOrListedTwice)
{
  expect_input_error(
    [] {
      read_text<2>(
        msh_22({}, {"1 0 0 0", "2 1 0 0", "3 1 1 0", "2 0 1 0", "4 0 1 0"}, {"2 3 2 9 1 1 2 3 4"}));
    },
    {"part.msh:9", "node number 2", "twice", "line 7"});
  // in other sections of elements too, and with gaps between the numbers
  expect_input_error(
    [] {
      read_text<2>(msh_22({}, two_squares, {quads[1], "4 1 2 7 1 1 8"}));
    },
    {"part.msh:16", "element 4, a line", "node 8"});
  expect_input_error(
    [] {
      read_text<2>(msh_22({}, {"1 0 0 0", "20 1 0 0", "3 1 1 0", "9 0 1 0"}, {"2 3 2 9 1 1 20 3 4"}));
    },
    {"element 2", "node 4"});
  read_text<2>(msh_22({}, {"1 0 0 0", "20 1 0 0", "3 1 1 0", "9 0 1 0"}, {"2 3 2 9 1 1 20 3 9"}));
}

TEST(ReadGmsh, RefusesTotalsThatDoNotMatchTheBlocks)
{
  const auto expect_refused = [](const std::string              &from,
                                 const std::string              &to,
                                 const std::vector<std::string> &words,
                                 const int                       line = __builtin_LINE()) {
    std::string text = squares_41;
    text.replace(text.find(from), from.size(), to);
    expect_input_error([&] { read_text<2>(text); }, words, __FILE__, line);
  };
  read_text<2>(squares_41);
  for (const char *total : {"0", "5", "7", "18446744073709551615"})
    {
      expect_refused("2 6 1 6", std::string("2 ") + total + " 1 6", {"part.msh:", "$Nodes", total, "hold 6"});
      expect_refused(
        "2 3 1 3", std::string("2 ") + total + " 1 3", {"part.msh:", "$Elements", total, "hold 3"});
    }
  expect_refused("2 6 1 6", "2 -6 1 6", {"$Nodes", "2 -6 1 6"});
  expect_refused("2 6 1 6", "2", {"$Nodes"});
  expect_refused("1 4 0 2", "1 4 1 2", {"Mesh.SaveParametric = 0"});
  expect_refused("2 1 3 2\n", "1 1 3 2\n", {"$Elements", "1 1 3 2"});
  expect_refused("1 9 1 4", "1 9 2 4", {"$Entities", "1 9 2 4"});
  expect_refused("4\n0 0 0", "4294967297\n0 0 0", {"$Nodes", "4294967297"});
}

TEST(ReadGmsh, RefusesSectionsInAnotherOrder)
{
  const std::string nodes = "$Nodes\n1\n1 0 0 0\n$EndNodes\n", elements = "$Elements\n0\n$EndElements\n";
  const std::string other = "$Comments\n$EndComments\n";
  const std::string good = msh_22({}, two_squares, {quads[1]}), start = good.substr(0, good.find("$Nodes"));
  const std::string end = good.substr(good.find("$Nodes"));
  read_text<2>(good + other);
  expect_input_error([&] { read_text<2>(good + nodes); }, {"part.msh:17", "$Nodes does not belong here"});
  expect_input_error([&] { read_text<2>(good + elements); }, {"$Elements does not belong here", "once each"});
  expect_input_error([&] { read_text<2>(start + elements + nodes); }, {"part.msh:7", "$Nodes"});
  expect_input_error([&] { read_text<2>(start + other + end); }, {"part.msh:4", "$Comments"});
}
