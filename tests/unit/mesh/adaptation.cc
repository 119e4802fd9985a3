// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/mesh/adaptation.h>

#include "mesh_test.h"

#include <deal.II/distributed/tria.h>

#include <set>

using namespace perideal;

namespace
{
  /// Refines twice what carries an error that falls with the distance from a corner, like r^-4.
  template <int dim>
  void adapt_to_corner(Mesh<dim> &mesh)
  {
    for (unsigned int time = 0; time < 2; ++time)
      {
        dealii::Vector<float> error(mesh.triangulation.n_active_cells());
        for (const auto &cell : mesh.triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            error[cell->active_cell_index()] = cell->measure() / std::pow(cell->center().norm(), 4.);
        ASSERT_TRUE(mark_largest(mesh, error, 100000));
        refine_marked(mesh);
      }
  }

  /// Ids of the active cells of all ranks.
  template <int dim>
  std::set<dealii::CellId> cells_of(const dealii::Triangulation<dim> &triangulation)
  {
    std::vector<dealii::CellId> mine;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        mine.push_back(cell->id());
    std::set<dealii::CellId> result;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(triangulation.get_communicator(), mine))
      result.insert(of_rank.begin(), of_rank.end());
    return result;
  }

  /// How many cells each rank owns.
  std::vector<std::uint64_t> cells_of_ranks(const dealii::Triangulation<2> &triangulation)
  {
    unsigned int mine = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      mine += cell->is_locally_owned();
    return dealii::Utilities::MPI::all_gather(MPI_COMM_WORLD, std::uint64_t(mine));
  }

  template <int dim>
  void expect_copies(Mesh<dim> &mesh)
  {
    adapt_to_corner(mesh);
    const auto cells = cells_of(mesh.triangulation);

    dealii::parallel::distributed::Triangulation<dim> copy(MPI_COMM_WORLD);
    copy_refined(mesh, 0, copy);
    EXPECT_EQ(cells_of(copy), cells);
    dealii::Triangulation<dim> serial;
    copy_refined(mesh, 0, serial);
    EXPECT_EQ(cells_of(serial), cells);
    dealii::parallel::distributed::Triangulation<dim> finer(MPI_COMM_WORLD);
    copy_refined(mesh, 1, finer);
    EXPECT_EQ(finer.n_global_active_cells(),
              mesh.triangulation.n_global_active_cells() * dealii::GeometryInfo<dim>::max_children_per_cell);

    test::expect_parents_of_all_cells(mesh);
  }
} // namespace

TEST(Adaptation, IsRememberedByCopiesOfThePlane)
{
  const auto mesh = test::generate<2>("box", {4, 3}, {1., 1.});
  expect_copies(*mesh);
  const auto refined = test::generate<2>("box", {2, 2}, {1., 1.}, 1);
  expect_copies(*refined);
}

TEST(Adaptation, IsRememberedByCopiesOfTheSolid)
{
  const auto mesh = test::generate<3>("box", {2, 3, 2}, {1., 1., 1.});
  expect_copies(*mesh);
}

TEST(Adaptation, RefinesTheCellsWithMostOfTheError)
{
  const auto            mesh = test::generate<2>("box", {4, 4}, {1., 1.});
  dealii::Vector<float> error(mesh->triangulation.n_active_cells());
  // One cell of sixteen has three quarters of the error.
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      error[cell->active_cell_index()] = cell->center().norm() < 0.2 ? 45. : 1.;
  EXPECT_FALSE(mark_largest(*mesh, error, 18)) << "three cells more are 19";
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    EXPECT_FALSE(cell->refine_flag_set());
  EXPECT_EQ(mesh->triangulation.n_global_active_cells(), 16u);
  ASSERT_TRUE(mark_largest(*mesh, error, 19));
  refine_marked(*mesh);
  const MeshFigures figures = measure(*mesh);
  EXPECT_EQ(figures.n_cells, 19u);
  EXPECT_EQ(figures.n_cells_by_level, (std::vector<dealii::types::global_cell_index>{15, 4}));
  EXPECT_NEAR(figures.smallest_size, 0.125, 1e-12);
  EXPECT_NE(mesh->description.find(", adapted"), std::string::npos);
}

TEST(Adaptation, CountsHalvingsAndIsRepeated)
{
  const auto mesh = test::generate<2>("box", {2, 2}, {1., 1.}, 1);
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    EXPECT_EQ(halvings(*mesh, cell), 0u) << "refined before the mesh adapts";
  adapt_to_corner(*mesh);
  unsigned int most = 0;
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        EXPECT_EQ(halvings(*mesh, cell), static_cast<unsigned int>(cell->level()) - 1u);
        most = std::max(most, halvings(*mesh, cell));
      }
  EXPECT_EQ(dealii::Utilities::MPI::max(most, MPI_COMM_WORLD), 2u);

  const auto again = test::generate<2>("box", {2, 2}, {1., 1.}, 1);
  adapt_like(mesh->adapted.refined, {}, *again);
  EXPECT_EQ(cells_of(again->triangulation), cells_of(mesh->triangulation));
  EXPECT_EQ(again->adapted.before, mesh->adapted.before);

  // Cells that are joined count less.
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      cell->set_coarsen_flag();
  refine_marked(*mesh);
  most = 0;
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      most = std::max(most, halvings(*mesh, cell));
  EXPECT_EQ(dealii::Utilities::MPI::max(most, MPI_COMM_WORLD), 1u);
}

TEST(Adaptation, BalancesRanksAndRepeatsIt)
{
  const auto mesh = test::generate<2>("box", {6, 6}, {1., 1.}, 1);
  adapt_to_corner(*mesh);
  // What lies in a corner is nine times as heavy.
  const auto weight = [](const auto &cell) { return cell->center().norm() < 0.5 ? 9000u : 1000u; };
  const auto load   = [&]() {
    double result = 0;
    for (const auto &cell : mesh->triangulation.active_cell_iterators())
      result += cell->is_locally_owned() ? weight(cell) : 0.;
    return dealii::Utilities::MPI::min_max_avg(result, MPI_COMM_WORLD);
  };
  const auto before = load();
  balance_ranks<2>(*mesh, weight);
  const auto after = load();
  // Four sisters stay on one rank.
  EXPECT_LE(after.max, after.avg + 4 * 9000.);
  EXPECT_LE(after.max,
            dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1 ? 0.8 * before.max : before.max);

  const auto again = test::generate<2>("box", {6, 6}, {1., 1.}, 1);
  adapt_like(mesh->adapted.refined, cells_of_ranks(mesh->triangulation), *again);
  EXPECT_EQ(cells_of_ranks(again->triangulation), cells_of_ranks(mesh->triangulation));
  std::vector<dealii::CellId> order, other;
  for (const auto &[cells, ids] : {std::pair<const dealii::Triangulation<2> &, std::vector<dealii::CellId> &>(
                                     mesh->triangulation, order),
                                   {again->triangulation, other}})
    for (const auto &cell : cells.active_cell_iterators())
      if (cell->is_locally_owned())
        ids.push_back(cell->id());
  EXPECT_EQ(order, other);
}
