// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/boundary_faces.h>
#include <perideal/operators/weights/gradient_moments.h>

#include "bodies.h"

#include <gtest/gtest.h>

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
        EXPECT_LT(20 * shared.faces->values().size(), alone.faces->values().size());
        EXPECT_LT(shared.moments.memory_consumption(), alone.moments.memory_consumption());
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
