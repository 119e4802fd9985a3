// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

#include <perideal/mesh/abaqus_to_gmsh.h>

using namespace perideal;
using namespace perideal::test;

namespace
{
  /// Two unit squares side by side, [0,2] x [0,1], with keywords in any letters, comments and continued
  /// lines.
  const std::string squares =
    "*Heading\n  two squares\n** a comment\n"
    "*Node, nset=all\n 1, 0., 0.\n 2, 1.\n 3, +1., 1.\n 4, , 1.\n 5, 2., 0.\n 6, 2., 1., 0.\n"
    " 99, 7., 7., 7.\n"
    "*ELEMENT, TYPE=cps4r,\n ELSET=Left\n 10, 1, 2, 3,\n 4\n"
    "*Element, type=CPE4I, elset=Right\n 20, 2, 5, 6, 3\n";

  /// The unit cube.
  const std::string abaqus_cube =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
    "*ELEMENT, TYPE=C3D8R, ELSET=cube\n1,1,2,3,4,5,6,7,8\n";

  template <int dim>
  std::unique_ptr<Mesh<dim>> read_deck(const std::string &text)
  {
    const TemporaryDirectory directory;
    return read<dim>(directory.write("deck.inp", text));
  }

  std::vector<std::string> notes_of(const std::string &text, const int dim)
  {
    return gmsh_of_abaqus(read_abaqus_deck(text, "deck.inp"), "deck.inp", dim).notes;
  }
} // namespace

TEST(AbaqusDeck, KeepsNamesOfElementSets)
{
  const auto mesh = read_deck<2>(squares);
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 2u);
  EXPECT_NEAR(measure(mesh->triangulation), 2., 1e-14) << "a node that no element has is left out";
  EXPECT_EQ(mesh->material_names.size(), 2u);
  EXPECT_NE(mesh->material_id("Left", "p"), mesh->material_id("Right", "p"));
}

TEST(AbaqusDeck, BoundariesAreSurfacesAndNodeSets)
{
  const auto mesh = read_deck<2>(squares + "*NSET, NSET=bottom\n1, 2, 5\n*NSET, NSET=corners\n1, 6\n"
                                           "*SURFACE, TYPE=ELEMENT, NAME=end\n RIGHT, S2\n"
                                           "*Surface, name=top, type=ELEMENT\n10, S3\n20, S3\n");
  EXPECT_NEAR(boundary_measure(*mesh, "bottom"), 2., 1e-14);
  EXPECT_NEAR(boundary_measure(*mesh, "end"), 1., 1e-14);
  EXPECT_NEAR(boundary_measure(*mesh, "top"), 2., 1e-14);
  EXPECT_EQ(mesh->boundary_names.count("corners"), 0u) << "two corners are no face";
}

TEST(AbaqusDeck, SidesOfHexahedraAreThoseOfTheManual)
{
  // Abaqus manual: S1 has the nodes 1-2-3-4, S2 5-8-7-6, S3 1-5-6-2, S4 2-6-7-3, S5 3-7-8-4, S6 4-8-5-1.
  std::string surfaces;
  for (int side = 1; side <= 6; ++side)
    surfaces += "*SURFACE, NAME=s" + std::to_string(side) + "\ncube, S" + std::to_string(side) + "\n";
  const auto mesh  = read_deck<3>(abaqus_cube + surfaces);
  const auto where = [&](const std::string &name) {
    const auto id = mesh->boundary_id(name, "p");
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->is_locally_owned() && cell->face(f)->boundary_id() == id)
          return cell->face(f)->center();
    return dealii::Point<3>(0.5, 0.5, 0.5);
  };
  if (mesh->triangulation.n_locally_owned_active_cells() == 0)
    return;
  EXPECT_EQ(where("s1"), dealii::Point<3>(0.5, 0.5, 0));
  EXPECT_EQ(where("s2"), dealii::Point<3>(0.5, 0.5, 1));
  EXPECT_EQ(where("s3"), dealii::Point<3>(0.5, 0, 0.5));
  EXPECT_EQ(where("s4"), dealii::Point<3>(1, 0.5, 0.5));
  EXPECT_EQ(where("s5"), dealii::Point<3>(0.5, 1, 0.5));
  EXPECT_EQ(where("s6"), dealii::Point<3>(0, 0.5, 0.5));
}

TEST(AbaqusDeck, SetsWithTheSameMembersAreOneGroup)
{
  const auto mesh =
    read_deck<2>(squares + "*NSET, NSET=load\n5, 6\n*SURFACE, TYPE=ELEMENT, NAME=end\n20, S2\n"
                           "*ELSET, ELSET=_end_S2, INTERNAL\n20\n"
                           "*ELSET, ELSET=part, GENERATE\n20, 20, 1\n");
  EXPECT_EQ(mesh->boundary_id("load", "p"), mesh->boundary_id("end", "p"));
  EXPECT_EQ(mesh->material_id("part", "p"), mesh->material_id("Right", "p"));
  EXPECT_EQ(mesh->material_names.count("_end_S2"), 0u) << "a name of Abaqus/CAE's own";
}

TEST(AbaqusDeck, SmallerSetsGoBeforeLarger)
{
  const std::string text  = squares + "*ELSET, ELSET=both\nLeft, Right\n*NSET, NSET=end\n5, 6\n";
  const auto        notes = notes_of(text, 2);
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[0].find("the set both shares members"), std::string::npos);
  EXPECT_NE(notes[1].find("the set all shares members with end"), std::string::npos);
  const auto mesh = read_deck<2>(text);
  EXPECT_EQ(mesh->material_names.count("both"), 0u);
  EXPECT_NEAR(boundary_measure(*mesh, "end"), 1., 1e-14);
}

TEST(AbaqusDeck, InstancesAreMoved)
{
  const auto mesh =
    read_deck<2>("*Part, name=p\n" + squares +
                 "*End Part\n*Assembly, name=a\n*Instance, name=p-1, part=p\n10., 20., 0.\n*End Instance\n"
                 "*Nset, nset=start, instance=p-1\n1, 4\n*Surface, name=out\np-1.Left, S4\n*End Assembly\n");
  EXPECT_NEAR(boundary_measure(*mesh, "start"), 1., 1e-14);
  EXPECT_EQ(mesh->boundary_id("start", "p"), mesh->boundary_id("out", "p"));
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    EXPECT_GT(cell->center()[1], 20.);
}

TEST(AbaqusDeck, RefusesWhatIsNoMesh)
{
  const auto refused = [](const std::string &text, const std::vector<std::string> &words) {
    expect_input_error([&] { read_deck<2>(text); }, words);
  };
  refused(squares + "*ELEMENT, TYPE=CPS8\n1,1,2,3,4,5,6,1,2\n", {"deck.inp:18", "CPS8"});
  refused(squares + "*ELEMENT, TYPE=CPS4\n30, 1, 2, 3\n", {"has 4 nodes, this one 3"});
  refused(squares + "*ELEMENT, TYPE=CPS4\n10, 1, 2, 3, 4\n", {"element 10 is given twice"});
  refused(squares + "*NODE\n1, 0, 0\n", {"node 1 is given twice"});
  refused(squares + "*NODE\n8, 0, x\n", {"'x' is no coordinate"});
  refused(squares + "*NSET, NSET=a\n1, b\n", {"there is no set b"});
  refused(squares + "*SURFACE, NAME=a, TYPE=ELEMENT\nLeft, S7\n", {"'S7' is no side"});
  refused(squares + "*SURFACE, NAME=a, TYPE=ELEMENT\nLeft, S5\n", {"has the side S5", "4 sides"});
  refused("*NODE\n1, 0, 0\n", {"no elements"});
}
