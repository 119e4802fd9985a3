// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/nodes/boundary_nodes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

using namespace perideal;

TEST(NodesOnBoundary, CountsFacesAndNotVertices)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::subdivided_hyper_cube(mesh.triangulation, 4, 0., 1., true);
  const Nodes<2> nodes(mesh, NodeParameters());
  // Boundary 0 is x = 0: four cells of width 1/4 have a face there.
  const auto selected = nodes_on_boundary(mesh, nodes, 0);
  EXPECT_EQ(dealii::Utilities::MPI::sum<unsigned int>(selected.size(), MPI_COMM_WORLD), 4u);
  for (const LocalIndex node : selected)
    EXPECT_NEAR(nodes.position[node][0], 1. / 8, 1e-15);

  EXPECT_TRUE(nodes_on_boundary(mesh, nodes, 42).empty());

  // Around the whole contour a corner cell counts once.
  for (const auto &cell : mesh.triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        face->set_boundary_id(3);
  EXPECT_EQ(
    dealii::Utilities::MPI::sum<unsigned int>(nodes_on_boundary(mesh, nodes, 3).size(), MPI_COMM_WORLD), 12u);
}
