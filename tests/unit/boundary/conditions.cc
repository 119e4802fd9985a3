// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/boundary_faces.h>
#include <perideal/boundary/dirichlet_nodes.h>
#include <perideal/boundary/mirror_layer.h>

#include "bodies.h"
#include "testing.h"

using namespace perideal;
using test::expect_input_error;

namespace
{
  /// Boundaries of the test boxes: 0 left, 1 right, 2 bottom, 3 top.
  struct Scene
  {
    explicit Scene(const std::vector<BoundaryConditionText> &conditions, const double distortion = 0.2)
      : mesh(test::make_box<2>({8, 6}, {1., 0.75}, distortion))
      , nodes(*mesh, NodeParameters{3.01})
      , faces(find_boundary_faces(*mesh, nodes))
    {
      LoadParameters parameters;
      parameters.conditions = conditions;
      loads                 = resolve_boundaries(*mesh, Loads<2>(parameters));
    }

    NodalVector field() const
    {
      dealii::IndexSet owned(2 * nodes.n_global);
      owned.add_range(2 * nodes.first_global, 2 * (nodes.first_global + nodes.size()));
      return NodalVector(owned, MPI_COMM_WORLD);
    }

    std::unique_ptr<Mesh<2>>     mesh;
    Nodes<2>                     nodes;
    std::vector<BoundaryFace<2>> faces;
    Loads<2>                     loads;
  };

  BoundaryConditionText condition(const std::string &name, const std::string &boundary)
  {
    BoundaryConditionText text;
    text.name     = name;
    text.boundary = boundary;
    return text;
  }

  BoundaryConditionText held(const std::string &boundary, const std::string &u_x, const std::string &u_y)
  {
    BoundaryConditionText text = condition("hold " + boundary, boundary);
    text.displacement          = {{u_x, u_y, ""}};
    return text;
  }

  double sum(const double value)
  {
    return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
  }
} // namespace

TEST(BoundaryFaces, CloseTheBody)
{
  const Scene          scene({held("0", "0", "0")});
  double               length = 0;
  dealii::Tensor<1, 2> closure;
  for (const auto &face : scene.faces)
    {
      length += face.area;
      closure += face.area * face.normal;
    }
  EXPECT_NEAR(sum(length), 3.5, 1e-13);
  EXPECT_LE(dealii::Utilities::MPI::sum(closure, MPI_COMM_WORLD).norm(), 1e-13);
}

TEST(BoundaryFaces, UnknownAndDoubleConditionsAreErrors)
{
  expect_input_error([] { Scene({held("nowhere", "0", "")}); }, {"hold nowhere/Boundary", "nowhere"});
  expect_input_error([] { Scene({held("17", "0", "")}); }, {"17"});
  expect_input_error([] { Scene({held("0", "0", ""), held("0", "1", "")}); }, {"twice", "along x"});
  auto pulled     = condition("pull", "0");
  pulled.traction = {{"1", "", ""}};
  expect_input_error([&] { Scene({held("0", "0", ""), pulled}); }, {"both prescribed"});
}

TEST(DirichletNodes, TakeTheBoundarysValue)
{
  const Scene             scene({held("0", "3*y*t", ""), held("3", "", "5")});
  const DirichletNodes<2> nodes(scene.faces, scene.loads, scene.nodes.size());
  NodalVector             u = scene.field();
  u                         = 7.;
  nodes.set_boundary_values(scene.loads, 2., u);
  double n_left = 0, n_top = 0;
  for (const auto &face : scene.faces)
    {
      if (face.boundary == 0)
        {
          EXPECT_NEAR(u.local_element(2 * face.node), 6 * face.centre[1], 1e-14);
          ++n_left;
        }
      if (face.boundary == 3)
        {
          EXPECT_EQ(u.local_element(2 * face.node + 1), 5.);
          ++n_top;
        }
    }
  EXPECT_EQ(sum(n_left), 6.);
  EXPECT_EQ(sum(n_top), 8.);
  double n_held = 0;
  for (const auto flag : nodes.mask())
    n_held += flag;
  EXPECT_EQ(sum(n_held), 14.);
}

TEST(DirichletNodes, ReactionsAreSummedByCondition)
{
  const Scene             scene({held("0", "0", "0"), held("1", "1", "")});
  const DirichletNodes<2> nodes(scene.faces, scene.loads, scene.nodes.size());
  NodalVector             force = scene.field();
  force                         = 2.;
  const auto reactions          = nodes.sum_by_condition(force, MPI_COMM_WORLD);
  EXPECT_NEAR(reactions[0][0], 12., 1e-13);
  EXPECT_NEAR(reactions[0][1], 12., 1e-13);
  EXPECT_NEAR(reactions[1][0], 12., 1e-13);
  EXPECT_NEAR(reactions[1][1], 0., 1e-13);
}

TEST(DirichletNodes, LayersTakeTheFieldAtTheirNodes)
{
  const Scene             scene({held("0", "3*y*t", ""), held("3", "x+1", "5")});
  const DirichletNodes<2> nodes(*scene.mesh, scene.nodes, scene.faces, scene.loads, 3);
  NodalVector             u = scene.field();
  u                         = 7.;
  nodes.set_boundary_values(scene.loads, 2., u);
  // The vertices of a cell of 1/8 move by 0.2 cells at most, which moves no centroid by half a cell.
  double n_left = 0, n_top = 0;
  for (LocalIndex i = 0; i < scene.nodes.size(); ++i)
    {
      const auto  &x       = scene.nodes.position[i];
      const bool   left    = x[0]<3. / 8, top = x[1]> 3. / 8;
      const double on_left = 6 * x[1], on_top = x[0] + 1;
      // Where both conditions hold, they count with equal shares.
      const double expected = left && top ? 0.5 * (on_left + on_top) : left ? on_left : top ? on_top : 7.;
      EXPECT_NEAR(u.local_element(2 * i), expected, 1e-14);
      EXPECT_EQ(u.local_element(2 * i + 1), top ? 5. : 7.);
      EXPECT_EQ(nodes.mask()[2 * i] == 1, left || top);
      n_left += left;
      n_top += top;
    }
  EXPECT_EQ(sum(n_left), 18.);
  EXPECT_EQ(sum(n_top), 24.);

  std::vector<dealii::Tensor<1, 2>> reference(scene.nodes.size(), dealii::Tensor<1, 2>({8., 9.}));
  nodes.set_nodal_values(reference, u);
  NodalVector force = scene.field();
  force             = 2.;
  // 24 nodes and, at the corner, half of 9; 15 of the left alone and the other half.
  const auto reactions = nodes.sum_by_condition(force, MPI_COMM_WORLD);
  EXPECT_NEAR(reactions[0][0], 2 * (9 + 4.5), 1e-13);
  EXPECT_NEAR(reactions[1][0], 2 * (15 + 4.5), 1e-13);
  EXPECT_NEAR(reactions[1][1], 2 * 24., 1e-13);
  for (LocalIndex i = 0; i < scene.nodes.size(); ++i)
    {
      EXPECT_EQ(nodes.mask()[2 * i] == 1, u.local_element(2 * i) == 8.);
      EXPECT_EQ(nodes.mask()[2 * i + 1] == 1, u.local_element(2 * i + 1) == 9.);
    }
}

/// Where cells meet at hanging vertices too, layers are the same on any number of ranks.
TEST(DirichletNodes, LayersCrossRanks)
{
  LoadParameters parameters;
  parameters.conditions = {held("0", "x", "0"), held("2", "", "y")};
  const Loads<2> loads(parameters);
  double         n_held[2];
  for (const int k : {0, 1})
    {
      const auto mesh =
        test::make_refined_box<2>({6, 5}, {0.4, 0.5}, 0.3, k == 0 ? MPI_COMM_SELF : MPI_COMM_WORLD);
      const Nodes<2>          nodes(*mesh, NodeParameters{3.01});
      const DirichletNodes<2> layers(
        *mesh, nodes, find_boundary_faces(*mesh, nodes), resolve_boundaries(*mesh, loads), 4);
      n_held[k] = std::count(layers.mask().begin(), layers.mask().end(), 1);
    }
  EXPECT_GT(n_held[0], 40.);
  EXPECT_EQ(sum(n_held[1]), n_held[0]);
}

TEST(DirichletNodes, InfiniteValuesAreErrors)
{
  // Finite at the boundary, a pole within.
  const Scene             scene({held("0", "0", "1/(x-0.0625)")}, 0.);
  const DirichletNodes<2> first(scene.faces, scene.loads, scene.nodes.size());
  first.check_finite(scene.loads, 1., MPI_COMM_WORLD);
  const DirichletNodes<2> nodes(*scene.mesh, scene.nodes, scene.faces, scene.loads, 2);
  expect_input_error([&] { nodes.check_finite(scene.loads, 1., MPI_COMM_WORLD); },
                     {"Boundary conditions/hold 0/u_y", "not a finite number"});
}

TEST(MirrorLayer, ImagesStandBehindThePlaneAndMoveAsTold)
{
  const Scene    scene({held("1", "1e-3*t", "")}, 0.);
  MirrorLayer<2> mirror(*scene.mesh, scene.nodes, scene.faces, scene.loads);
  EXPECT_TRUE(mirror.keeps_symmetry());
  EXPECT_GT(sum(mirror.n_fictitious()), 0.);
  for (LocalIndex i = 0; i < mirror.nodes().size(); ++i)
    EXPECT_EQ(mirror.nodes().position[i][0] > 1., i >= mirror.n_real());
  // A field that meets the condition at the plane is continued smoothly: u_x = 1e-3 t x, u_y = x-independent.
  NodalVector u = scene.field();
  for (LocalIndex i = 0; i < scene.nodes.size(); ++i)
    {
      u.local_element(2 * i)     = 2e-3 * scene.nodes.position[i][0];
      u.local_element(2 * i + 1) = scene.nodes.position[i][1];
    }
  mirror.set_time(scene.loads, 2.);
  dealii::IndexSet owned(2 * mirror.nodes().n_global);
  owned.add_range(2 * mirror.nodes().first_global, 2 * (mirror.nodes().first_global + mirror.nodes().size()));
  NodalVector extended(owned, MPI_COMM_WORLD);
  mirror.extend(u, true, extended);
  for (LocalIndex i = 0; i < mirror.nodes().size(); ++i)
    {
      EXPECT_NEAR(extended.local_element(2 * i), 2e-3 * mirror.nodes().position[i][0], 1e-15);
      EXPECT_NEAR(extended.local_element(2 * i + 1), mirror.nodes().position[i][1], 1e-15);
    }
}

TEST(MirrorLayer, CornersAreFilled)
{
  const Scene          scene({held("1", "0", ""), held("3", "", "0")}, 0.);
  const MirrorLayer<2> mirror(*scene.mesh, scene.nodes, scene.faces, scene.loads);
  double               n_corner = 0;
  for (LocalIndex i = mirror.n_real(); i < mirror.nodes().size(); ++i)
    n_corner += mirror.nodes().position[i][0] > 1. && mirror.nodes().position[i][1] > 0.75;
  EXPECT_GE(sum(n_corner), 36.); // two horizons are six cells
}

TEST(MirrorLayer, ClampedPlanesBreakTheSymmetry)
{
  const Scene          scene({held("1", "0", "0")});
  const MirrorLayer<2> mirror(*scene.mesh, scene.nodes, scene.faces, scene.loads);
  EXPECT_FALSE(mirror.keeps_symmetry());
}

TEST(MirrorLayer, BentBoundariesAreErrors)
{
  Scene scene({held("1", "0", "")}, 0.);
  for (auto &face : scene.faces)
    if (face.boundary == 1)
      for (auto &vertex : face.vertices)
        vertex[0] += 0.1 * vertex[1] * vertex[1];
  expect_input_error([&] { MirrorLayer<2>(*scene.mesh, scene.nodes, scene.faces, scene.loads); },
                     {"Displacement treatment", "plane"});
}
