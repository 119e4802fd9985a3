// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_test.h"

#include <perideal/output/files.h>
#include <perideal/output/profiles.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;
using namespace output_test;

namespace
{
  /// Writes a profile of sample() under the name "pd" and reads it back.
  template <int dim>
  std::vector<std::vector<double>>
  write_and_read(const Mesh<dim> &mesh, const dealii::types::boundary_id boundary, const std::string &name)
  {
    const std::string directory = scratch_directory(name);
    create_output_directory(directory, MPI_COMM_WORLD);
    const Nodes<dim> nodes(mesh, NodeParameters());
    BoundaryProfile<dim>(mesh, nodes, boundary)
      .write(directory + "/profile.csv", {{"pd", sample_at_nodes(nodes)}});
    return read_csv(directory + "/profile.csv");
  }

  std::string header_of(const std::string &name)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    return read_lines("scratch_output/" + name + "_" + std::to_string(n_ranks) + "/profile.csv").at(0);
  }

  /// Every row carries the field of its own point.
  template <int dim>
  void expect_values_at_their_points(const std::vector<std::vector<double>> &rows)
  {
    for (const auto &row : rows)
      {
        ASSERT_EQ(row.size(), 1u + 2 * dim);
        dealii::Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = row[1 + d];
        for (unsigned int d = 0; d < dim; ++d)
          EXPECT_DOUBLE_EQ(row[1 + dim + d], sample(x)[d]);
      }
  }
} // namespace

TEST(BoundaryProfile, GoesRoundAnAnnulusByAngle)
{
  constexpr unsigned int n_cells = 24;
  const dealii::Point<2> centre(3, -2);
  Mesh<2>                mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_shell(mesh.triangulation, centre, 1., 2., n_cells, true);
  mesh.triangulation.refine_global(1);

  for (const dealii::types::boundary_id boundary : {0, 1})
    {
      const auto rows = write_and_read(mesh, boundary, "annulus");
      EXPECT_EQ(header_of("annulus"), "angle [deg],x [m],y [m],pd_u_x,pd_u_y");
      ASSERT_EQ(rows.size(), 2 * n_cells);
      expect_values_at_their_points<2>(rows);
      for (unsigned int i = 0; i < rows.size(); ++i)
        {
          const dealii::Tensor<1, 2> arm = dealii::Point<2>(rows[i][1], rows[i][2]) - centre;
          // Regular polygons: equal steps from half a cell on, round-off in degrees.
          EXPECT_NEAR(rows[i][0], (i + 0.5) * 180. / n_cells, 1e-9);
          EXPECT_NEAR(std::tan(rows[i][0] * M_PI / 180) * arm[0], arm[1], 1e-9);
          EXPECT_TRUE(boundary == 0 ? arm.norm() < 1.5 : arm.norm() > 1.5);
        }
    }
}

TEST(BoundaryProfile, FindsTheHoleOfAnEccentricPlate)
{
  Mesh<2>                mesh(MPI_COMM_WORLD);
  const dealii::Point<2> hole(0.25, 0.5);
  dealii::GridGenerator::plate_with_a_hole(
    mesh.triangulation, 0.4, 1., 0.5, 0.5, 1., 2., hole, 0, 1, 1., 2, true);
  mesh.triangulation.refine_global(2);
  const Nodes<2>           nodes(mesh, NodeParameters());
  const BoundaryProfile<2> profile(mesh, nodes, 4);
  EXPECT_TRUE(profile.is_closed());

  const auto rows = write_and_read(mesh, 4, "hole");
  ASSERT_EQ(rows.size(), 32u);
  expect_values_at_their_points<2>(rows);
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      // The cells are skew, so their centroids stand at no round angles.
      const dealii::Tensor<1, 2> arm = dealii::Point<2>(rows[i][1], rows[i][2]) - hole;
      EXPECT_NEAR(arm[0], arm.norm() * std::cos(rows[i][0] * M_PI / 180), 1e-12);
      EXPECT_NEAR(arm[1], arm.norm() * std::sin(rows[i][0] * M_PI / 180), 1e-12);
      EXPECT_LT(arm.norm(), 0.55);
      EXPECT_GT(rows[i][0], i == 0 ? 0. : rows[i - 1][0]);
    }
}

TEST(BoundaryProfile, FollowsAnOpenEdgeFromItsLowerEnd)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::subdivided_hyper_rectangle(
    mesh.triangulation, {3, 8}, dealii::Point<2>(-1, -2), dealii::Point<2>(1, 2), true);
  // Boundary 1 is the right edge, x = 1.
  const auto rows = write_and_read(mesh, 1, "edge");
  EXPECT_EQ(header_of("edge"), "s [m],x [m],y [m],pd_u_x,pd_u_y");
  ASSERT_EQ(rows.size(), 8u);
  expect_values_at_their_points<2>(rows);
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      EXPECT_NEAR(rows[i][0], (i + 0.5) * 0.5, 1e-14);
      EXPECT_NEAR(rows[i][1], 2. / 3, 1e-14);
      EXPECT_NEAR(rows[i][2], -2 + rows[i][0], 1e-14);
    }
}

TEST(BoundaryProfile, TakesAQuarterOfAHoleForOpen)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::quarter_hyper_shell(mesh.triangulation, dealii::Point<2>(), 1., 2., 0, true);
  mesh.triangulation.refine_global(3);
  const Nodes<2> nodes(mesh, NodeParameters());
  EXPECT_FALSE(BoundaryProfile<2>(mesh, nodes, 0).is_closed());

  const auto rows = write_and_read(mesh, 0, "quarter");
  ASSERT_GT(rows.size(), 8u);
  for (unsigned int i = 1; i < rows.size(); ++i)
    {
      EXPECT_GT(rows[i][1], rows[i - 1][1]);
      EXPECT_LT(rows[i][2], rows[i - 1][2]);
    }
}

TEST(BoundaryProfile, SortsByAngleThenHeightInThreeDimensions)
{
  constexpr unsigned int n_angles = 16, n_layers = 3;
  Mesh<3>                mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::cylinder_shell(mesh.triangulation, 6., 1., 2., n_angles, n_layers);
  for (const auto &cell : mesh.triangulation.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && std::hypot(face->center()[0], face->center()[1]) < 1.1)
        face->set_boundary_id(7);

  const auto rows = write_and_read(mesh, 7, "cylinder");
  EXPECT_EQ(header_of("cylinder"), "angle [deg],x [m],y [m],z [m],pd_u_x,pd_u_y,pd_u_z");
  ASSERT_EQ(rows.size(), n_angles * n_layers);
  expect_values_at_their_points<3>(rows);
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      EXPECT_NEAR(rows[i][0], (i / n_layers + 0.5) * 360. / n_angles, 1e-9);
      EXPECT_NEAR(rows[i][3], 1. + 2. * (i % n_layers), 1e-12);
    }
}

TEST(BoundaryProfile, TakesAFaceAcrossZForOpen)
{
  Mesh<3> mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<3> nodes(mesh, NodeParameters());
  EXPECT_FALSE(BoundaryProfile<3>(mesh, nodes, 5).is_closed());
}

TEST(BoundaryProfile, OfAnAbsentBoundaryHasAHeaderOnly)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  EXPECT_TRUE(write_and_read(mesh, 99, "absent").empty());
  EXPECT_EQ(header_of("absent"), "s [m],x [m],y [m],pd_u_x,pd_u_y");
}

TEST(LineProfile, TakesTheCellsThatTheLinePassesThrough)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::subdivided_hyper_rectangle(
    mesh.triangulation, {8, 4}, dealii::Point<2>(0, 0), dealii::Point<2>(8, 4));
  const Nodes<2>    nodes(mesh, NodeParameters());
  const std::string directory = scratch_directory("line");
  create_output_directory(directory, MPI_COMM_WORLD);
  const auto rows_of = [&](const dealii::Point<2> &from, const dealii::Point<2> &to) {
    LineProfile<2>(mesh, nodes, from, to).write(directory + "/profile.csv", {{"pd", sample_at_nodes(nodes)}});
    return read_csv(directory + "/profile.csv");
  };

  // Along a row of nodes, from its second cell on and backwards: by distance from the beginning.
  const auto along = rows_of({6.2, 1.5}, {1.8, 1.5});
  ASSERT_EQ(along.size(), 6u);
  for (unsigned int k = 0; k < 6; ++k)
    {
      EXPECT_NEAR(along[k][0], k - 0.3, 1e-12);
      EXPECT_NEAR(along[k][1], 6.5 - k, 1e-12);
    }
  expect_values_at_their_points<2>(along);
  EXPECT_EQ(header_of("line"), "s [m],x [m],y [m],pd_u_x,pd_u_y");

  // On the edge between two rows: the cells of both.
  EXPECT_EQ(rows_of({0.5, 2.}, {2.5, 2.}).size(), 6u);
  // Across, and through no cell at all.
  EXPECT_EQ(rows_of({3.5, -1.}, {3.5, 9.}).size(), 4u);
  EXPECT_EQ(rows_of({0., 5.}, {8., 5.}).size(), 0u);
}
