// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/neighbourhood/precrack.h>

#include "bodies.h"
#include "msh_box.h"
#include "testing.h"

#include <perideal/mesh/create_mesh.h>

using namespace perideal;
using test::expect_input_error;

namespace
{
  template <int dim>
  Precrack<dim> crack_of(const PrecrackText &text)
  {
    return Precrack<dim>(text, Mesh<dim>(MPI_COMM_SELF));
  }

  /// A file with a crack along the left half of the middle line or plane across the last axis.
  template <int dim>
  std::unique_ptr<Mesh<dim>> cracked_box(const unsigned int n, const unsigned int refinements)
  {
    const test::TemporaryDirectory directory;
    const std::string              d = std::to_string(dim - 1);
    MeshParameters                 parameters;
    parameters.refinements = refinements;
    parameters.file        = directory.write(
      "box.msh",
      test::msh_box<dim>(n, {d + " 8 \"crack\""}, [](const dealii::Point<dim> &centre, const bool is_inner) {
        return is_inner && centre[dim - 1] == 0.5 && centre[0] < 0.5 ? 8 : -1;
      }));
    return create_mesh<dim>(parameters, MPI_COMM_WORLD, "");
  }

  /// The bonds that the group cuts are those that points cut.
  template <int dim>
  void expect_the_same_cuts(const unsigned int n, const unsigned int refinements, const std::string &points)
  {
    const auto            mesh = cracked_box<dim>(n, refinements);
    const test::Body<dim> body(*mesh);
    PrecrackText          group;
    group.name     = "c";
    group.boundary = "crack";
    const Precrack<dim>  by_group(group, *mesh), by_points({"c", points}, *mesh);
    const Families<dim> &families = *body.families;
    GlobalIndex          n_cut    = 0;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
        {
          const auto &a = families.position[i], &b = families.position[*j];
          ASSERT_EQ(by_group.crosses(a, b), by_points.crosses(a, b)) << a << " to " << b;
          n_cut += by_group.crosses(a, b);
        }
    EXPECT_GT(dealii::Utilities::MPI::sum(n_cut, MPI_COMM_WORLD), 50u);
  }
} // namespace

TEST(Precrack, GroupsOfTheMeshCutAsPointsDo)
{
  expect_the_same_cuts<2>(4, 0, "0, 0.5; 0.5, 0.5");
  expect_the_same_cuts<2>(4, 2, "0, 0.5; 0.5, 0.5");
  expect_the_same_cuts<2>(40, 0, "0, 0.5; 0.5, 0.5");
  const std::string square = "0, 0, 0.5; 0.5, 0, 0.5; 0.5, 1, 0.5; 0, 1, 0.5";
  expect_the_same_cuts<3>(6, 0, square);
  expect_the_same_cuts<3>(4, 1, square);
}

TEST(Precrack, IsEitherPointsOrAGroup)
{
  PrecrackText text;
  text.name = "c";
  expect_input_error([&] { crack_of<2>(text); }, {"Precracks/c", "either", "set Points, or Boundary"});
  text.points   = "0, 0; 1, 1";
  text.boundary = "crack";
  expect_input_error([&] { crack_of<2>(text); }, {"Precracks/c", "not both"});
  text.points = "";
  expect_input_error([&] { crack_of<2>(text); }, {"Precracks/c/Boundary", "crack", "none"});
}

TEST(Precrack, LinesCutWhatCrossesThem)
{
  const auto crack = crack_of<2>({"c", "0, 0.5; 0.5, 0.5; 0.75, 0.75"});
  EXPECT_TRUE(crack.crosses({0.2, 0.4}, {0.2, 0.6}));
  EXPECT_TRUE(crack.crosses({0.2, 0.6}, {0.3, 0.4}));
  EXPECT_TRUE(crack.crosses({0.6, 0.7}, {0.6, 0.5}));
  EXPECT_FALSE(crack.crosses({0.2, 0.6}, {0.3, 0.7}));
  EXPECT_FALSE(crack.crosses({0.8, 0.7}, {0.8, 0.9}));
  // Through the tip: cut. Beside it: not.
  EXPECT_TRUE(crack.crosses({0.7, 0.8}, {0.8, 0.7}));
  EXPECT_FALSE(crack.crosses({0.7, 0.801}, {0.801, 0.7}));
  // A point on the crack belongs to one side of it.
  EXPECT_NE(crack.crosses({0.2, 0.5}, {0.2, 0.6}), crack.crosses({0.2, 0.5}, {0.2, 0.4}));
}

TEST(Precrack, PolygonsCutWhatCrossesThem)
{
  // An L in the plane x + y + z = 1.
  const auto                 crack = crack_of<3>({"c", "1,0,0; 0,1,0; 0,0,1; 0.3,0.3,0.4"});
  const dealii::Tensor<1, 3> normal(dealii::Point<3>(0.1, 0.1, 0.1));
  const auto cuts = [&](const dealii::Point<3> &x) { return crack.crosses(x - normal, x + normal); };
  EXPECT_TRUE(cuts({0.2, 0.5, 0.3}));
  EXPECT_FALSE(cuts({0.5, 0.2, 0.3})); // in the notch of the polygon
  EXPECT_FALSE(cuts({-0.2, 0.6, 0.6}));
  EXPECT_TRUE(cuts({0.5, 0.5, 0.}));  // on the edge
  EXPECT_TRUE(cuts({0.3, 0.3, 0.4})); // at a corner
  EXPECT_FALSE(crack.crosses({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}));
}

TEST(Precrack, WrongTextIsAnError)
{
  expect_input_error([] { crack_of<2>({"c", "0, 1"}); }, {"Precracks/c/Points", "two points"});
  expect_input_error([] { crack_of<2>({"c", "0, 1; 0, 1"}); }, {"Precracks/c/Points", "twice"});
  expect_input_error([] { crack_of<2>({"c", "0, 1, 2; 0, 1, 3"}); }, {"Precracks/c/Points", "2 coordinates"});
  expect_input_error([] { crack_of<3>({"c", "0,0,0; 1,0,0"}); }, {"Precracks/c/Points", "three points"});
  expect_input_error(
    [] {
      crack_of<3>({"c", "0,0,0; 1,0,0; 2,0,0"});
    },
    {"Precracks/c/Points", "plane polygon"});
  expect_input_error(
    [] {
      crack_of<3>({"c", "0,0,0; 1,0,0; 1,1,0; 0,1,1"});
    },
    {"Precracks/c/Points", "plane polygon"});
}
