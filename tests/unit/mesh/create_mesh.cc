// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

#include <deal.II/base/numbers.h>
#include <deal.II/fe/mapping_q.h>

#include <cmath>
#include <map>

using namespace perideal;
using namespace perideal::test;

namespace
{
  /// Length of boundary by id, to compare triangulations.
  template <int dim>
  std::map<dealii::types::boundary_id, double>
  boundary_measures(const dealii::Triangulation<dim> &triangulation)
  {
    std::map<dealii::types::boundary_id, double> measures;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            measures[face->boundary_id()] += face->measure();
    for (dealii::types::boundary_id id = 0; id < 8; ++id)
      measures[id] = dealii::Utilities::MPI::sum(measures[id], MPI_COMM_WORLD);
    return measures;
  }
} // namespace

TEST(CopyRefined, FollowsTheHole)
{
  const auto                                      mesh = generate<2>("plate with hole", {2, 2}, {}, 1);
  dealii::parallel::distributed::Triangulation<2> copy(MPI_COMM_WORLD);
  copy_refined(*mesh, 2, copy);
  EXPECT_EQ(copy.n_global_active_cells(), 32u * 64);
  EXPECT_NEAR(measure(copy), plate_area(128), 1e-13);
  // the square's sides keep their ids and length, the hole is a finer polygon
  const auto before = boundary_measures(mesh->triangulation), after = boundary_measures(copy);
  for (dealii::types::boundary_id id = 0; id < 4; ++id)
    EXPECT_NEAR(after.at(id), 1., 1e-13);
  EXPECT_LT(before.at(4), after.at(4));
  EXPECT_NEAR(after.at(4), 128 * 0.2 * std::sin(dealii::numbers::PI / 128), 1e-13);
}

TEST(CopyRefined, CopiesSpaceIntoASerialTriangulation)
{
  const auto               mesh = generate<3>("plate with hole", {1, 1, 1}, {1., 0.2});
  dealii::Triangulation<3> copy;
  copy_refined(*mesh, 1, copy);
  EXPECT_EQ(copy.n_active_cells(), 64u);
  EXPECT_NEAR(
    measure(copy) / dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD), 0.2 * plate_area(16), 1e-13);
}

TEST(CopyRefined, KeepsMaterials)
{
  const TemporaryDirectory directory;
  const auto               mesh =
    read<2>(directory.write("mesh.msh", msh_22({}, two_squares, {"3 3 2 3 1 1 2 3 4", "4 3 2 4 1 2 5 6 3"})));
  dealii::parallel::distributed::Triangulation<2> copy(MPI_COMM_WORLD);
  copy_refined(*mesh, 2, copy);
  EXPECT_EQ(copy.n_global_active_cells(), 32u);
  for (const auto &cell : copy.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        EXPECT_EQ(cell->material_id(), cell->center()[0] < 1. ? 3u : 4u);
      }
}

TEST(CreateMesh, HigherMappingsSeeTheCircle)
{
  const auto                mesh = generate<2>("plate with hole", {2, 2});
  const dealii::MappingQ<2> mapping(4);
  const double              area = dealii::GridTools::volume(mesh->triangulation, mapping);
  // degree four on arcs of 22.5 degrees; the polygon is off by 8e-4
  EXPECT_NEAR(area, 1 - dealii::numbers::PI * 0.01, 1e-8);
}

TEST(CreateMesh, CylindersOfFilesAreFollowed)
{
  MeshParameters parameters;
  parameters.file              = "meshes/plate_unstructured.msh";
  parameters.cylinders["hole"] = dealii::Point<2>(0., 0.);
  const auto   mesh            = create_mesh<2>(parameters, MPI_COMM_WORLD, "");
  const double missing         = measure(mesh->triangulation) - (1 - dealii::numbers::PI * 0.01);
  parameters.refinements       = 1;
  const auto fine              = create_mesh<2>(parameters, MPI_COMM_WORLD, "");
  // polygons approach the circle at second order: a quarter
  EXPECT_NEAR((measure(fine->triangulation) - (1 - dealii::numbers::PI * 0.01)) / missing, 0.25, 1e-3);

  parameters.cylinders["hole"] = dealii::Point<2>(0.01, 0.);
  expect_input_error([&] { create_mesh<2>(parameters, MPI_COMM_WORLD, ""); },
                     {"Mesh/Cylinders", "between 0.09", "not a circular cylinder"});
  parameters.cylinders = {{"holes", dealii::Point<2>()}};
  expect_input_error([&] { create_mesh<2>(parameters, MPI_COMM_WORLD, ""); },
                     {"Mesh/Cylinders", "did you mean: hole"});
}

TEST(CreateMesh, MayBeRefinedLocally)
{
  const auto mesh = generate<2>("plate with hole", {4, 3});
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center().norm() < 0.3)
      cell->set_refine_flag();
  mesh->triangulation.execute_coarsening_and_refinement();
  EXPECT_GT(mesh->triangulation.n_global_active_cells(), 96u);
  EXPECT_NEAR(measure(mesh->triangulation), plate_area(64), 1e-13);
}
