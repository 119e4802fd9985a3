// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/boundary_faces.h>
#include <perideal/operators/weights/gradient_moments.h>
#include <perideal/operators/weights/gradient_rows.h>

#include "bodies.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace perideal;

// Cells and faces that are equal but for rounding share what is stored of them.

namespace
{
  /// Gradients and moments of a free body's cells.
  template <int dim>
  struct Cells
  {
    Cells(const Mesh<dim> &mesh, const test::Body<dim> &body, const bool share_equal)
      : polynomials(std::make_shared<const CellPolynomials<dim>>(mesh,
                                                                 body.nodes,
                                                                 typename CellPolynomials<dim>::Stiffness(),
                                                                 BondPredicate<dim>(),
                                                                 CellUnknown::mean,
                                                                 share_equal))
      , faces(std::make_shared<const FaceMoments<dim>>(
          mesh, *polynomials, [](const auto) { return 1.; }, BondPredicate<dim>(), share_equal))
      , moments(polynomials,
                faces,
                std::make_shared<FaceValues<dim>>(faces->boundary_points(), Loads<dim>(LoadParameters())),
                MPI_COMM_WORLD)
    {
    }

    std::shared_ptr<const CellPolynomials<dim>> polynomials;
    std::shared_ptr<const FaceMoments<dim>>     faces;
    GradientMoments<dim>                        moments;
  };

  /// Cells of equal records have the same rows.
  /// @return how many on this rank have one of a cell before
  template <int dim>
  unsigned int expect_equal_rows(const Cells<dim> &cells, const std::vector<double> &spacing)
  {
    using Row = typename GradientRows<dim>::Row;
    const GradientRows<dim> rows(
      *cells.polynomials, *cells.faces, cells.moments.prescribed_values(), std::vector<GlobalIndex>());
    EqualRecords                     equal(true);
    std::vector<EqualRecords::Entry> record;
    std::vector<Row>                 known;
    Row                              row, listed;
    unsigned int                     result = 0;
    for (LocalIndex i = 0; i < cells.moments.n_owned(); ++i)
      {
        rows.compute(i, row);
        rows.list_columns(i, listed);
        EXPECT_EQ(listed.column, row.column);
        if (!equal.is_looking() || !rows.describe(i, record))
          continue;
        std::size_t &place = equal.place_of(record);
        if (place == EqualRecords::none)
          {
            place = known.size();
            known.push_back(row);
            continue;
          }
        ++result;
        const Row &like = known[place];
        EXPECT_EQ(row.column.size(), like.column.size());
        for (std::size_t k = 0; k < std::min(row.column.size(), like.column.size()); ++k)
          {
            EXPECT_LT((row.gradient_of(0)[k] - like.gradient_of(0)[k]).norm(), 1e-12 / spacing[i]);
            EXPECT_LT((row.moment_of(0)[k] - like.moment_of(0)[k]).norm(), 1e-12 * std::pow(spacing[i], dim));
          }
      }
    return result;
  }

  template <int dim>
  void expect_as_without_sharing(const Mesh<dim> &mesh, const double least, const double most)
  {
    const test::Body<dim> body(mesh, 2.015);
    const Cells<dim>      shared(mesh, body, true), alone(mesh, body, false);
    EXPECT_EQ(alone.polynomials->n_shared(), 0u);
    const double share =
      static_cast<double>(shared.polynomials->n_shared()) / shared.polynomials->columns().size();
    EXPECT_GE(share, least);
    EXPECT_LE(share, most);
    if (least > 0)
      {
        EXPECT_LT(20 * shared.faces->shapes().size(), alone.faces->shapes().size());
        EXPECT_LT(shared.moments.memory_consumption(), alone.moments.memory_consumption());
      }

    const unsigned int n_equal = expect_equal_rows(shared, body.nodes.spacing);
    if (least > 0 && body.nodes.size() > 400)
      {
        EXPECT_GT(n_equal, body.nodes.size() / 10);
      }
    NodalVector u;
    u.reinit(body.families->make_partitioner(dim));
    for (LocalIndex i = 0; i < body.nodes.size(); ++i)
      for (int d = 0; d < dim; ++d)
        u.local_element(dim * i + d) = test::scatter(body.nodes.position[i], d);
    shared.moments.read(u, GradientMoments<dim>::AtFaces::nothing);
    alone.moments.read(u, GradientMoments<dim>::AtFaces::nothing);
    for (LocalIndex i = 0; i < body.nodes.size(); ++i)
      {
        const double h = body.nodes.spacing[i];
        for (unsigned int l = 0; l < dim; ++l)
          for (int a = 0; a < dim; ++a)
            {
              EXPECT_NEAR(
                shared.moments.gradient(i)[l].value[a], alone.moments.gradient(i)[l].value[a], 1e-12 / h);
              for (unsigned int k = 0; k < dim; ++k)
                EXPECT_NEAR(shared.moments.moment(i)[dim * k + l].value[a],
                            alone.moments.moment(i)[dim * k + l].value[a],
                            1e-12 * body.nodes.volume[i]);
            }
      }
  }
} // namespace

TEST(EqualCells, OfRegularMeshesShare)
{
  expect_as_without_sharing<2>(*test::make_box<2>({40, 36}, {1., 0.9}, 0.), 0.8, 1.);
  expect_as_without_sharing<2>(*test::make_box<2>({40, 40}, {1., 0.7}, 0.), 0.8, 1.);
  expect_as_without_sharing<3>(*test::make_box<3>({12, 11, 12}, {1., 0.8, 0.3}, 0.), 0.6, 1.);
}

TEST(EqualCells, OfDistortedMeshesDoNot)
{
  expect_as_without_sharing<2>(*test::make_box<2>({40, 36}, {1., 0.9}, 0.2), 0., 0.);
  expect_as_without_sharing<3>(*test::make_box<3>({8, 8, 8}, {1., 1., 1.}, 0.2), 0., 0.);
}

// Where the mesh is refined, cells are equal by level.
TEST(EqualCells, ShareBesideHangingFaces)
{
  auto mesh = test::make_box<2>({32, 32}, {1., 1.}, 0.);
  for (const auto &cell : mesh->triangulation.active_cell_iterators())
    if (cell->is_locally_owned() && cell->center()[0] < 0.5)
      cell->set_refine_flag();
  mesh->triangulation.execute_coarsening_and_refinement();
  expect_as_without_sharing<2>(*mesh, 0.6, 1.);
}
