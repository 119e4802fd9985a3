// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/nodes/nodes.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

#include "bodies.h"
#include "testing.h"

using namespace perideal;

TEST(Nodes, VolumesAndFirstMomentsAreExact)
{
  // Centroids weighted with volumes give the body's centroid on any mesh; the
  // means of vertices would not.
  for (const auto &mesh : test::make_boxes<2>())
    {
      mesh->thickness = 0.5;
      const Nodes<2>       nodes(*mesh, NodeParameters{3.});
      double               volume = 0;
      dealii::Tensor<1, 2> moment;
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          volume += nodes.volume[i];
          moment += nodes.volume[i] * nodes.position[i];
          EXPECT_NEAR(nodes.spacing[i] * nodes.spacing[i] * 0.5, nodes.volume[i], 1e-15);
          EXPECT_NEAR(nodes.horizon[i], 3 * nodes.spacing[i], 1e-15);
        }
      volume               = dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD);
      moment               = dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD);
      const auto       box = dealii::GridTools::compute_bounding_box(mesh->triangulation);
      dealii::Point<2> upper;
      for (int d = 0; d < 2; ++d)
        upper[d] = dealii::Utilities::MPI::max(box.upper_bound(d), MPI_COMM_WORLD);
      EXPECT_NEAR(volume, 0.5 * upper[0] * upper[1], 1e-14);
      for (int d = 0; d < 2; ++d)
        EXPECT_NEAR(moment[d] / volume, 0.5 * upper[d], 1e-14);
    }
}

TEST(Nodes, CentroidOfADistortedHex)
{
  const auto     mesh = test::make_box<3>({3, 3, 3}, {1., 1., 1.}, 0.3);
  const Nodes<3> nodes(*mesh, NodeParameters{3.});
  double         volume = 0, moment = 0, vertex_moment = 0;
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        const LocalIndex i = nodes.node_of_cell[cell->active_cell_index()];
        volume += nodes.volume[i];
        moment += nodes.volume[i] * nodes.position[i][0];
        vertex_moment += nodes.volume[i] * cell->center()[0];
      }
  EXPECT_NEAR(dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD), 1., 1e-14);
  EXPECT_NEAR(dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD), 0.5, 1e-14);
  EXPECT_GT(std::abs(dealii::Utilities::MPI::sum(vertex_moment, MPI_COMM_WORLD) - 0.5), 1e-6)
    << "the test mesh does not tell centroids from means of vertices";
}

TEST(Nodes, NumbersAreContiguousOverRanks)
{
  const auto     mesh = test::make_box<2>({9, 7}, {1., 1.}, 0.);
  const Nodes<2> nodes(*mesh, NodeParameters{3.});
  EXPECT_EQ(nodes.n_global, 63u);
  GlobalIndex expected = 0;
  const auto  sizes    = dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, nodes.size());
  for (unsigned int rank = 0; rank < dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD); ++rank)
    expected += sizes[rank];
  EXPECT_EQ(nodes.first_global, expected);
}

TEST(Nodes, RejectHorizonsThatMakeNoFamilies)
{
  const auto mesh = test::make_box<2>({3, 3}, {1., 1.}, 0.);
  for (const double factor : {-3., 0., 1., 100., std::nan("")})
    test::expect_input_error([&] { Nodes<2>(*mesh, NodeParameters{factor}); }, {"Nodes/Horizon factor"});
}

namespace
{
  NodeParameters perturbed(const double eta)
  {
    NodeParameters result;
    result.perturbation = eta;
    return result;
  }

  /// Nodes stay within their cells and keep all but their places.
  template <int dim>
  void expect_within_cells(const Mesh<dim> &mesh)
  {
    const Nodes<dim> before(mesh, perturbed(0.)), after(mesh, perturbed(0.5));
    EXPECT_EQ(before.volume, after.volume);
    EXPECT_EQ(before.horizon, after.horizon);
    EXPECT_EQ(before.node_of_cell, after.node_of_cell);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const LocalIndex i = before.node_of_cell[cell->active_cell_index()];
          EXPECT_TRUE(cell->point_inside(after.position[i])) << after.position[i] << " left its cell";
          EXPECT_GT(after.position[i].distance(before.position[i]), 0.);
        }
  }

  /// Positions of all ranks, in ascending order.
  template <int dim>
  std::vector<std::array<double, dim>> sorted_positions(const Nodes<dim> &nodes)
  {
    std::vector<std::array<double, dim>> own, result;
    for (const auto &x : nodes.position)
      {
        own.emplace_back();
        std::copy_n(x.begin_raw(), dim, own.back().begin());
      }
    for (const auto &part : dealii::Utilities::MPI::all_gather(nodes.communicator, own))
      result.insert(result.end(), part.begin(), part.end());
    std::sort(result.begin(), result.end());
    return result;
  }
} // namespace

TEST(Nodes, PerturbedOnesStayInTheirCells)
{
  expect_within_cells<2>(*test::make_box<2>({9, 7}, {1., 1.}, 0.));
  expect_within_cells<2>(*test::make_box<2>({9, 7}, {1., 1.}, 0.3));
  expect_within_cells<2>(*test::make_box<2>({30, 2}, {1., 1.}, 0.2));
  expect_within_cells<3>(*test::make_box<3>({5, 4, 4}, {1., 1., 1.}, 0.2));
}

TEST(Nodes, PerturbationsAreUniformAboutTheCentroids)
{
  // Cells of 0.025 x 0.1: each direction has its own edge. Uniform numbers in [-1/2, 1/2] have mean 0 and
  // mean square 1/12; of 800 of them four standard deviations of these are 0.041 and 0.0105.
  const auto     mesh = test::make_box<2>({40, 20}, {1., 2.}, 0.);
  const Nodes<2> before(*mesh, perturbed(0.)), tenth(*mesh, perturbed(0.1)), half(*mesh, perturbed(0.5));
  const double   edge[] = {0.025, 0.1};
  for (int d = 0; d < 2; ++d)
    {
      double mean = 0, square = 0, largest = 0;
      for (LocalIndex i = 0; i < before.size(); ++i)
        {
          const double share = (half.position[i][d] - before.position[i][d]) / (0.5 * edge[d]);
          mean += share / 800;
          square += share * share / 800;
          largest = std::max(largest, std::abs(share));
          EXPECT_NEAR(tenth.position[i][d] - before.position[i][d], 0.1 * edge[d] * share, 1e-15);
        }
      EXPECT_NEAR(dealii::Utilities::MPI::sum(mean, MPI_COMM_WORLD), 0., 0.041);
      EXPECT_NEAR(dealii::Utilities::MPI::sum(square, MPI_COMM_WORLD), 1. / 12, 0.0105);
      EXPECT_LE(largest, 0.5 + 1e-12);
    }
}

TEST(Nodes, PerturbationsDoNotDependOnRanks)
{
  const auto distributed = test::make_refined_box<2>({8, 8}, {0.3, 0.4}, 0.3);
  const auto alone       = test::make_refined_box<2>({8, 8}, {0.3, 0.4}, 0.3, MPI_COMM_SELF);
  const auto found       = sorted_positions(Nodes<2>(*distributed, perturbed(0.5)));
  const auto expected    = sorted_positions(Nodes<2>(*alone, perturbed(0.5)));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int d = 0; d < 2; ++d)
      EXPECT_NEAR(found[i][d], expected[i][d], 1e-14);
}

TEST(Nodes, RejectPerturbationsThatLeaveCells)
{
  const auto mesh = test::make_box<2>({3, 3}, {1., 1.}, 0.);
  for (const double eta : {-0.1, 0.7, std::nan("")})
    test::expect_input_error([&] { Nodes<2>(*mesh, perturbed(eta)); }, {"Nodes/Perturbation", "0 to 0.5"});
}
