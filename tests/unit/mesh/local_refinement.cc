// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_test.h"

#include <perideal/mesh/local_refinement.h>
#include <perideal/mesh/parent_mesh.h>

#include <deal.II/grid/grid_generator.h>

#include <map>
#include <set>

using namespace perideal;
using namespace perideal::test;

namespace
{
  template <int dim>
  std::unique_ptr<Mesh<dim>> refined_plate(const unsigned int global,
                                           const unsigned int times,
                                           const unsigned int layers,
                                           MPI_Comm           communicator = MPI_COMM_WORLD)
  {
    MeshParameters parameters;
    parameters.generator   = "plate with hole";
    parameters.cells       = dim == 2 ? std::vector<unsigned int>{4, 5} : std::vector<unsigned int>{2, 4, 2};
    parameters.refinements = global;
    if (times > 0)
      parameters.refine_at = {"hole", "left"};
    parameters.refine_times  = times;
    parameters.refine_layers = layers;
    return create_mesh<dim>(parameters, communicator, "");
  }

  /// Number of active cells of all ranks on each level.
  template <int dim>
  std::map<int, std::uint64_t> cells_by_level(const dealii::Triangulation<dim> &triangulation)
  {
    std::map<int, std::uint64_t> result;
    for (unsigned int level = 0; level < triangulation.n_global_levels(); ++level)
      result[level] = 0;
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        ++result[cell->level()];
    for (auto &entry : result)
      entry.second = dealii::Utilities::MPI::sum(entry.second, triangulation.get_communicator());
    return result;
  }

  /// The parent mesh has the parents of all cells, and covers the same body.
  template <int dim>
  void expect_parents(const Mesh<dim> &mesh)
  {
    expect_parents_of_all_cells(mesh);
    const auto parents = create_parent_mesh(mesh);

    dealii::Triangulation<dim> serial;
    copy_refined(mesh, -1, serial);
    EXPECT_EQ(serial.n_active_cells(), parents->n_global_active_cells());
    EXPECT_NEAR(
      measure(*parents), measure(serial) / dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD), 1e-13);
    std::set<dealii::types::boundary_id> ids;
    for (const auto &cell : parents->active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            ids.insert(face->boundary_id());
    EXPECT_EQ(dealii::Utilities::MPI::compute_set_union(ids, MPI_COMM_WORLD), mesh.boundary_ids);
  }

  /// A unit box of eight cells a side, refined globally, and then where x < .6.
  template <int dim>
  std::unique_ptr<Mesh<dim>> refined_box(const unsigned int global, const unsigned int times)
  {
    MeshParameters parameters;
    parameters.generator    = "box";
    parameters.cells        = std::vector<unsigned int>(dim, 8);
    parameters.size         = std::vector<double>(dim, 1.);
    parameters.refinements  = global;
    parameters.refine_where = times > 0 ? "x<0.6" : "";
    parameters.refine_times = times;
    return create_mesh<dim>(parameters, MPI_COMM_WORLD, "");
  }

  /// No parent has cells on both sides of an inclined crack, whose faces have no hanging vertices, while
  /// others stay undivided.
  template <int dim>
  void expect_divided_along_crack(const Mesh<dim> &mesh)
  {
    const BondPredicate<dim> is_cut = [](const dealii::Point<dim> &a, const dealii::Point<dim> &b) {
      const auto height = [](const dealii::Point<dim> &x) { return x[1] - 0.47 - 0.2 * x[0]; };
      return a[0] < 0.4 && b[0] < 0.4 && (height(a) < 0) != (height(b) < 0);
    };
    expect_parents_of_all_cells(mesh, is_cut);
    const auto parents = create_parent_mesh(mesh, is_cut);
    EXPECT_GT(parents->n_global_active_cells(), create_parent_mesh(mesh)->n_global_active_cells());

    unsigned int n_at_crack = 0;
    for (const auto &cell : parents->active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto in_mesh = mesh.triangulation.create_cell_iterator(cell->id());
          for (unsigned int a = 0; a < in_mesh->n_children(); ++a)
            for (unsigned int b = 0; b < a; ++b)
              EXPECT_FALSE(is_cut(in_mesh->child(a)->center(), in_mesh->child(b)->center()));
          for (const unsigned int f : cell->face_indices())
            if (!cell->at_boundary(f) && cell->neighbor(f)->is_active() &&
                is_cut(cell->center(), cell->neighbor(f)->center()))
              {
                ++n_at_crack;
                EXPECT_EQ(cell->level(), cell->neighbor(f)->level());
              }
        }
    EXPECT_GT(dealii::Utilities::MPI::sum(n_at_crack, MPI_COMM_WORLD), 0u);
  }
} // namespace

TEST(LocalRefinement, ReachesEveryCellThatTouches)
{
  // Of the re-entrant corner's two faces only one is marked; the cells around
  // its vertices are to be refined, those on the other side with a vertex only.
  dealii::Triangulation<2> corner;
  dealii::GridGenerator::hyper_L(corner);
  corner.refine_global(2);
  const auto   on_marked = [](const dealii::Point<2> &x) { return std::abs(x[0]) < 1e-12 && x[1] > -1e-12; };
  unsigned int n_marked  = 0;
  for (const auto &face : corner.active_face_iterators())
    if (face->at_boundary())
      {
        const bool marked = on_marked(face->vertex(0)) && on_marked(face->vertex(1));
        face->set_boundary_id(marked ? 1 : 0);
        n_marked += marked ? 1 : 0;
      }
  ASSERT_EQ(n_marked, 4u);
  LocalRefinement refinement;
  refinement.boundaries = {1};
  refinement.times      = 1;
  refine_locally(refinement, corner);
  unsigned int n_at_vertex = 0;
  for (const auto &cell : corner.active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices())
      if (on_marked(cell->vertex(v)))
        {
          EXPECT_EQ(cell->level(), 3);
          n_at_vertex += cell->vertex(v).norm() < 1e-12 ? 1 : 0;
        }
  EXPECT_EQ(n_at_vertex, 3u);
  // four cells along the faces and two beyond the corner
  EXPECT_EQ(corner.n_active_cells(), 48u + 3 * 6);
}

TEST(LocalRefinement, FollowsCurvesWithoutHangingVertices)
{
  const auto mesh = refined_plate<2>(1, 2, 1);
  // 8 blocks of 4 cells around, refined three times: a closed polygon of 256 sides
  EXPECT_NEAR(boundary_measure(*mesh, "hole"), 256 * 0.2 * std::sin(dealii::numbers::PI / 256), 1e-13);
  EXPECT_NEAR(measure(mesh->triangulation), plate_area(256), 1e-13);
  EXPECT_NE(mesh->description.find("refined 2 times at hole"), std::string::npos);
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && face->boundary_id() == mesh->boundary_id("hole", "test"))
          {
            EXPECT_EQ(cell->level(), 3);
          }
}

TEST(LocalRefinement, LayersAreDeepOnAnyNumberOfRanks)
{
  for (const unsigned int layers : {1, 2, 4})
    {
      const auto shared = refined_plate<2>(2, 2, layers),
                 alone  = refined_plate<2>(2, 2, layers, MPI_COMM_SELF);
      EXPECT_EQ(cells_by_level(shared->triangulation), cells_by_level(alone->triangulation));
    }
  // A row of cells refined from the left: 3 layers of 8 columns, then 3 of their 6.
  MeshParameters parameters;
  parameters.generator     = "box";
  parameters.cells         = {8, 4};
  parameters.refine_at     = {"left"};
  parameters.refine_times  = 2;
  parameters.refine_layers = 3;
  const auto box           = create_mesh<2>(parameters, MPI_COMM_WORLD, "");
  EXPECT_EQ(cells_by_level(box->triangulation),
            (std::map<int, std::uint64_t>{{0, 5 * 4}, {1, 3 * 8}, {2, 6 * 16}}));
}

TEST(LocalRefinement, ReachesPlaces)
{
  MeshParameters parameters;
  parameters.generator    = "box";
  parameters.cells        = {8, 8};
  parameters.size         = {1., 1.};
  parameters.refine_where = "x > 0.3 && abs(y - 0.5) < 0.01";
  parameters.refine_times = 2;
  const auto mesh         = create_mesh<2>(parameters, MPI_COMM_WORLD, "");
  EXPECT_NE(mesh->description.find("refined 2 times where x > 0.3"), std::string::npos);
  // Two rows of 6 cells have a vertex there, the first one at x = 0.375; of their children two rows of 12,
  // the first one with a vertex at x = 0.3125.
  const auto levels = cells_by_level(mesh->triangulation);
  EXPECT_EQ(levels.at(2), 4u * 2u * 12u);
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] > 0.3 && std::abs(cell->center()[1] - 0.5) < 0.06)
      {
        EXPECT_EQ(cell->level(), 2);
      }
  dealii::parallel::distributed::Triangulation<2> copy(MPI_COMM_WORLD);
  copy_refined(*mesh, 0, copy);
  EXPECT_EQ(cells_by_level(copy), levels);

  parameters.refine_where = "z > 0";
  expect_input_error([&] { create_mesh<2>(parameters, MPI_COMM_WORLD, ""); },
                     {"Mesh/Refine where", "it has no z"});
}

TEST(LocalRefinement, CopiesAreRefinedAlike)
{
  const auto                                      mesh = refined_plate<2>(1, 2, 2);
  dealii::parallel::distributed::Triangulation<2> copy(MPI_COMM_WORLD);
  copy_refined(*mesh, 0, copy);
  EXPECT_EQ(cells_by_level(copy), cells_by_level(mesh->triangulation));
  dealii::parallel::distributed::Triangulation<2> fine(MPI_COMM_WORLD);
  copy_refined(*mesh, 1, fine);
  EXPECT_EQ(fine.n_global_active_cells(), 4 * mesh->triangulation.n_global_active_cells());
  EXPECT_NEAR(measure(fine), plate_area(512), 1e-13);
  dealii::Triangulation<2> serial;
  copy_refined(*mesh, 0, serial);
  EXPECT_EQ(serial.n_active_cells(), mesh->triangulation.n_global_active_cells());
}

TEST(ParentMesh, HasTheParentsOfAllCells)
{
  EXPECT_FALSE(has_parents(*refined_plate<2>(0, 0, 1)));
  expect_parents(*refined_plate<2>(1, 0, 1));
  expect_parents(*refined_plate<2>(3, 0, 1));
  expect_parents(*refined_plate<2>(1, 2, 1));
  expect_parents(*refined_plate<2>(2, 2, 3));
  expect_parents(*refined_plate<2>(0, 1, 1));
  expect_parents(*refined_plate<2>(0, 3, 2));
  expect_parents(*refined_plate<3>(1, 0, 1));
  expect_parents(*refined_plate<3>(1, 1, 2));
  expect_parents(*refined_plate<3>(0, 2, 1));
}

TEST(ParentMesh, StaysDividedAlongCracks)
{
  expect_divided_along_crack(*refined_box<2>(1, 0));
  expect_divided_along_crack(*refined_box<2>(2, 0));
  expect_divided_along_crack(*refined_box<2>(1, 1));
  expect_divided_along_crack(*refined_box<2>(0, 2));
  expect_divided_along_crack(*refined_box<3>(1, 0));
  expect_divided_along_crack(*refined_box<3>(1, 1));
}

// A crack along faces of the parents divides none of them.
TEST(ParentMesh, IsWholeWhereCracksRunAlongItsFaces)
{
  const auto             mesh   = refined_box<2>(1, 0);
  const BondPredicate<2> is_cut = [](const dealii::Point<2> &a, const dealii::Point<2> &b) {
    return (a[1] < 0.5) != (b[1] < 0.5);
  };
  EXPECT_EQ(create_parent_mesh(*mesh, is_cut)->n_global_active_cells(), n_parent_cells(*mesh));
}

TEST(ParentMesh, IsCountedWhereRefinementIsUniform)
{
  EXPECT_EQ(n_parent_cells(*refined_plate<2>(2, 0, 1)), 160u * 4);
  EXPECT_EQ(n_parent_cells(*refined_plate<3>(1, 0, 1)), 128u);
}

TEST(RefinedMesh, FoldedCellsAreRefused)
{
  // The lower edge of a flat cell on a circle that bulges beyond the upper one.
  const TemporaryDirectory directory;
  MeshParameters           parameters;
  parameters.file             = directory.write("bulge.msh",
                                    msh_22({"1 7 \"rim\""},
                                           {"1 -1 0 0", "2 1 0 0", "3 1 .3 0", "4 -1 .3 0"},
                                           {"1 1 2 7 1 1 2", "2 3 2 9 1 1 2 3 4"}));
  parameters.cylinders["rim"] = dealii::Point<2>(0., -0.1);
  create_mesh<2>(parameters, MPI_COMM_WORLD, "");
  parameters.refinements = 1;
  expect_input_error([&] { create_mesh<2>(parameters, MPI_COMM_WORLD, ""); },
                     {"bulge.msh", "Mesh/Refinements", "after refinement", "folded"});
}
