// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/neighbourhood/connected_parts.h>

#include <deal.II/base/mpi.h>

#include "bodies.h"
#include "testing.h"

#include <set>

using namespace perideal;

namespace
{
  /// A row of 12 x 3(, x 3) unit cells without those between two places along x.
  template <int dim>
  std::unique_ptr<Mesh<dim>> make_row_with_gap(const double from, const double to)
  {
    dealii::Triangulation<dim> whole;
    dealii::Point<dim>         lower, upper;
    std::vector<unsigned int>  cells(dim, 3);
    cells[0] = 12;
    for (int d = 0; d < dim; ++d)
      upper[d] = cells[d];
    dealii::GridGenerator::subdivided_hyper_rectangle(whole, cells, lower, upper);
    std::set<typename dealii::Triangulation<dim>::active_cell_iterator> gap;
    for (const auto &cell : whole.active_cell_iterators())
      if (cell->center()[0] > from && cell->center()[0] < to)
        gap.insert(cell);
    auto mesh = std::make_unique<Mesh<dim>>(MPI_COMM_WORLD);
    dealii::GridGenerator::create_triangulation_with_removed_cells(whole, gap, mesh->triangulation);
    return mesh;
  }

  template <int dim>
  ConnectedParts<dim> parts_with_gap(const double from, const double to, const bool is_cut)
  {
    const auto            mesh = make_row_with_gap<dim>(from, to);
    const test::Body<dim> body(*mesh, 2.5);
    return ConnectedParts<dim>(
      *mesh, body.nodes, *body.families, [&](const auto &, const auto &) { return is_cut; });
  }

  /// Bonds join what lies nearer than the horizon, unless they are cut.
  template <int dim>
  void expect_parts()
  {
    const auto whole = parts_with_gap<dim>(0., 0., false);
    EXPECT_EQ(whole.n_parts, 1u);
    EXPECT_EQ(whole.n_bodies, 1u);
    EXPECT_TRUE(whole.body_of_node.empty());

    const auto near = parts_with_gap<dim>(5., 6., false);
    EXPECT_EQ(near.n_parts, 2u);
    EXPECT_EQ(near.n_bodies, 1u);
    // Across one cell: straight ahead, and to the sides: 3 and 2 x 2 in 2-D, 9, 4 x 6 and 4 x 4 in 3-D.
    EXPECT_EQ(near.n_bonds_across, dim == 2 ? 7u : 49u);

    const auto cut = parts_with_gap<dim>(5., 6., true);
    EXPECT_EQ(cut.n_bodies, 2u);
    EXPECT_EQ(cut.n_bonds_across, 0u);

    const auto far = parts_with_gap<dim>(4., 8., false);
    EXPECT_EQ(far.n_parts, 2u);
    EXPECT_EQ(far.n_bodies, 2u);
    EXPECT_EQ(far.n_bonds_across, 0u);
  }

  /// Nodes left and right of the gap are of different bodies, on whatever rank.
  template <int dim>
  void expect_sides()
  {
    const auto                mesh = make_row_with_gap<dim>(4., 8.);
    const test::Body<dim>     body(*mesh, 2.5);
    const ConnectedParts<dim> parts(*mesh, body.nodes, *body.families, nullptr);
    for (LocalIndex i = 0; i < body.nodes.size(); ++i)
      EXPECT_EQ(parts.body_of_node[i], body.nodes.position[i][0] < 6. ? 0u : 1u);
  }
} // namespace

TEST(ConnectedParts, Bodies)
{
  expect_parts<2>();
  expect_parts<3>();
}

TEST(ConnectedParts, Nodes)
{
  expect_sides<2>();
  expect_sides<3>();
}
