// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/nodes/nodes.h>

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
