// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/nodes/mesh_points.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;

namespace
{
  template <typename Dimension>
  class MeshPointsTest : public testing::Test
  {
  };
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(MeshPointsTest, Dimensions);

  /// Four cells of width 1/4 along each axis, that at the origin refined where asked.
  template <int dim>
  struct PointsOfCube
  {
    explicit PointsOfCube(const bool refine)
      : mesh(MPI_COMM_WORLD)
    {
      dealii::GridGenerator::subdivided_hyper_cube(mesh.triangulation, 4);
      if (refine)
        {
          for (const auto &cell : mesh.triangulation.active_cell_iterators())
            if (cell->is_locally_owned() && cell->center().norm() < 0.25)
              cell->set_refine_flag();
          mesh.triangulation.execute_coarsening_and_refinement();
        }
      nodes  = std::make_unique<Nodes<dim>>(mesh, NodeParameters());
      graph  = std::make_shared<const CellGraph<dim>>(mesh, *nodes);
      points = std::make_unique<MeshPoints<dim>>(mesh, graph);
    }

    /// Opens the plane x = 1/2 above y = 1/2.
    void crack()
    {
      points->open([&](const LocalIndex i, const LocalIndex j) {
        const auto &a = graph->position[i], &b = graph->position[j];
        return (a[0] < 0.5) != (b[0] < 0.5) && a[1] > 0.5 && b[1] > 0.5;
      });
    }

    /// Values at the corners of the owned cells.
    template <typename Function>
    std::vector<CornerValues<dim>> at_corners(const Function &function) const
    {
      std::vector<CornerValues<dim>> result(nodes->size());
      for (LocalIndex i = 0; i < nodes->size(); ++i)
        for (unsigned int v = 0; v < points->n_corners; ++v)
          result[i][v] = function(points->cell(i)->vertex(v), graph->position[i]);
      return result;
    }

    /// Vertices of cells of all ranks that a point is at, one for each number.
    std::vector<dealii::Point<dim>> place_of_numbers() const
    {
      std::vector<double> x(dim * points->n_points(), 0.);
      std::vector<double> found(points->n_points(), 0.);
      GlobalIndex         number = 0;
      const GlobalIndex   n_own  = points->own_points().size();
      MPI_Exscan(&n_own, &number, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
      for (const auto &corner : points->own_points())
        {
          for (int d = 0; d < dim; ++d)
            x[dim * number + d] = points->cell(corner.node)->vertex(corner.corner)[d];
          found[number++] = 1.;
        }
      dealii::Utilities::MPI::sum(x, MPI_COMM_WORLD, x);
      dealii::Utilities::MPI::sum(found, MPI_COMM_WORLD, found);
      std::vector<dealii::Point<dim>> result(points->n_points());
      for (std::size_t p = 0; p < result.size(); ++p)
        {
          EXPECT_EQ(found[p], 1.) << "ranks of point " << p;
          for (int d = 0; d < dim; ++d)
            result[p][d] = x[dim * p + d];
        }
      return result;
    }

    Mesh<dim>                             mesh;
    std::unique_ptr<Nodes<dim>>           nodes;
    std::shared_ptr<const CellGraph<dim>> graph;
    std::unique_ptr<MeshPoints<dim>>      points;
  };

  template <int dim>
  void expect_points_at_corners(const PointsOfCube<dim> &cube)
  {
    const auto places = cube.place_of_numbers();
    for (LocalIndex i = 0; i < cube.nodes->size(); ++i)
      for (unsigned int v = 0; v < MeshPoints<dim>::n_corners; ++v)
        {
          const GlobalIndex number = cube.points->numbers()[i][v];
          ASSERT_LT(number, places.size());
          EXPECT_EQ(places[number].distance(cube.points->cell(i)->vertex(v)), 0.);
        }
  }
} // namespace

TYPED_TEST(MeshPointsTest, AreTheVerticesOfTheMesh)
{
  constexpr int           dim = TypeParam::value;
  const PointsOfCube<dim> cube(false), refined(true);
  EXPECT_EQ(cube.points->n_points(), dim == 2 ? 25u : 125u);
  expect_points_at_corners(cube);
  // The refined cell has a vertex on each edge, in each face and in its middle.
  EXPECT_EQ(refined.points->n_points(), dim == 2 ? 25u + 5u : 125u + 19u);
  expect_points_at_corners(refined);
}

TYPED_TEST(MeshPointsTest, CracksHaveTwoSides)
{
  constexpr int     dim = TypeParam::value;
  PointsOfCube<dim> cube(false);
  cube.crack();
  // Those at y = 3/4 and y = 1 are doubled; at the tip, y = 1/2, the sides hang together below.
  EXPECT_EQ(cube.points->n_points(), dim == 2 ? 25u + 2u : 125u + 10u);
  expect_points_at_corners(cube);

  // 1 on the left, 3 on the right: what is not on the crack has the mean of both.
  const auto sides = cube.points->mean(cube.at_corners([](const auto &, const auto &node) {
    dealii::Tensor<1, dim> result;
    result[0] = node[0] < 0.5 ? 1. : 3.;
    return result;
  }));
  for (LocalIndex i = 0; i < cube.nodes->size(); ++i)
    for (unsigned int v = 0; v < MeshPoints<dim>::n_corners; ++v)
      {
        const auto   at    = cube.points->cell(i)->vertex(v);
        const double own   = cube.graph->position[i][0] < 0.5 ? 1. : 3.;
        const bool   mixes = std::abs(at[0] - 0.5) < 1e-12 && at[1] < 0.6;
        EXPECT_DOUBLE_EQ(sides[i][v][0], mixes ? 2. : own) << at;
      }

  // Beside the crack the cells of its other side are none around.
  for (LocalIndex i = 0; i < cube.nodes->size(); ++i)
    if (const auto &x = cube.graph->position[i]; x[1] > 0.75)
      for (const LocalIndex j : cube.points->cells_around(i))
        {
          EXPECT_EQ(x[0] < 0.5, cube.graph->position[j][0] < 0.5) << x;
        }

  cube.points->open([](const LocalIndex, const LocalIndex) { return false; });
  EXPECT_EQ(cube.points->n_points(), dim == 2 ? 25u : 125u);
}

TYPED_TEST(MeshPointsTest, HangingVerticesLieOnTheirEdges)
{
  constexpr int           dim = TypeParam::value;
  const PointsOfCube<dim> cube(true);
  const auto              square = [](const dealii::Point<dim> &x) {
    dealii::Tensor<1, dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = x[d] * x[d];
    return result;
  };
  const auto values =
    cube.points->mean(cube.at_corners([&](const auto &x, const auto &) { return square(x); }));
  for (LocalIndex i = 0; i < cube.nodes->size(); ++i)
    for (unsigned int v = 0; v < MeshPoints<dim>::n_corners; ++v)
      {
        const auto x        = cube.points->cell(i)->vertex(v);
        auto       expected = square(x);
        // On the faces x = 1/4, y = 1/4, ... the larger cells are straight from 0 to 1/4.
        bool hangs = false;
        for (int d = 0; d < dim; ++d)
          hangs = hangs || std::abs(x[d] - 0.25) < 1e-12;
        for (int d = 0; d < dim; ++d)
          if (hangs && std::abs(x[d] - 0.125) < 1e-12)
            expected[d] = 0.5 * 0.0625;
        EXPECT_NEAR((values[i][v] - expected).norm(), 0., 1e-15) << x;
      }
}
