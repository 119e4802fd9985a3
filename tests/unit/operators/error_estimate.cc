// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/boundary_faces.h>
#include <perideal/operators/post/error_estimate.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>

#include "bodies.h"
#include "testing.h"

using namespace perideal;

namespace
{
  template <int dim>
  ElasticSolid<dim> solid()
  {
    ElasticConstants constants;
    constants.young_modulus = 70e9;
    constants.poisson_ratio = 0.3;
    constants.assumption    = dim == 2 ? PlaneAssumption::plane_strain : PlaneAssumption::solid;
    return constants;
  }

  /// The estimate of a displacement that is given by formulas, whose means the cells have.
  /// @param held the boundaries (numbered as by hyper_rectangle) where it is prescribed; the others are free
  template <int dim>
  ErrorEstimate estimate_of(const Mesh<dim>                    &mesh,
                            const std::array<std::string, dim> &displacement,
                            const std::vector<unsigned int>    &held)
  {
    LoadParameters text;
    for (const unsigned int id : held)
      {
        BoundaryConditionText condition;
        condition.name = condition.boundary = std::to_string(id);
        for (int d = 0; d < dim; ++d)
          condition.displacement[d] = displacement[d];
        text.conditions.push_back(condition);
      }
    const Loads<dim>      loads = resolve_boundaries(mesh, Loads<dim>(text));
    const test::Body<dim> body(mesh, 2.01);
    const auto            polynomials = std::make_shared<const CellPolynomials<dim>>(mesh, body.nodes);
    const auto            face_moments =
      std::make_shared<const FaceMoments<dim>>(mesh, *polynomials, [](const auto) { return 1.; });
    const auto values = std::make_shared<FaceValues<dim>>(face_moments->boundary_points(), loads);
    values->set_time(loads, 1.);
    const GradientMoments<dim> moments(polynomials, face_moments, values, MPI_COMM_WORLD);

    std::array<SpaceTimeFunction<dim>, dim> function;
    for (int d = 0; d < dim; ++d)
      function[d] = SpaceTimeFunction<dim>(displacement[d], "displacement");
    NodalVector                         means(body.families->make_partitioner(dim));
    std::vector<dealii::Tensor<1, dim>> at_nodes(body.nodes.size());
    const dealii::FE_Nothing<dim>       no_shape;
    dealii::FEValues<dim>               points(
      no_shape, dealii::QGauss<dim>(4), dealii::update_quadrature_points | dealii::update_JxW_values);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const LocalIndex i = body.nodes.node_of_cell[cell->active_cell_index()];
          points.reinit(cell);
          for (int d = 0; d < dim; ++d)
            {
              for (const unsigned int q : points.quadrature_point_indices())
                means.local_element(dim * i + d) +=
                  points.JxW(q) / cell->measure() * function[d].value(points.quadrature_point(q), 1.);
              at_nodes[i][d] = function[d].value(body.nodes.position[i], 1.);
            }
        }
    const ElasticSolid<dim> material = solid<dim>();
    return estimate_error<dim>(
      moments, [&](const auto) { return material; }, loads, 1., means, at_nodes);
  }

  template <int dim>
  std::vector<unsigned int> all_sides()
  {
    std::vector<unsigned int> result;
    for (unsigned int id = 0; id < 2 * dim; ++id)
      result.push_back(id);
    return result;
  }

  template <int dim>
  std::unique_ptr<Mesh<dim>> make_cube(const unsigned int n)
  {
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    return test::make_box<dim>(std::vector<unsigned int>(dim, n), size, 0.);
  }

  /// Nothing is wrong with a quadratic displacement, nor with a body that moves as a whole.
  template <int dim>
  void expect_no_error_of_quadratic_fields()
  {
    std::array<std::string, dim> quadratic, moved;
    for (int d = 0; d < dim; ++d)
      {
        quadratic[d] = std::to_string(1 + d) + "*x^2 - x*y + 0.3*y^2 + 0.2*x";
        moved[d]     = d == 0 ? "0.7 - 0.1*y" : d == 1 ? "0.1*x" : "1.3";
      }
    for (const auto &mesh : test::make_boxes<dim>())
      {
        EXPECT_LE(estimate_of<dim>(*mesh, quadratic, all_sides<dim>()).total(), 1e-11);
        EXPECT_EQ(estimate_of<dim>(*mesh, moved, {}).total(), 0.);
      }
  }

  /// Cells add up to the whole.
  void expect_sum_of_cells(const ErrorEstimate &estimate)
  {
    double sum = 0;
    for (const double of_cell : estimate.of_cells)
      {
        EXPECT_GE(of_cell, 0.);
        sum += of_cell;
      }
    EXPECT_NEAR(dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD), estimate.total(), 1e-10 * estimate.total());
  }

  /// A uniform strain e along x whose tractions are missing all around. With h the size of a cell,
  /// T = U 2 h (1 + (dim - 1) (C12/C11)^2), t^2 = 2 h^3 (1 + (dim - 1) (C12/C11)^2)/(1/3), and half of the
  /// displacement is a translation: 1 - (1/2)^2/(1/3) = 1/4.
  template <int dim>
  void expect_missing_tractions()
  {
    std::array<std::string, dim> stretch;
    stretch.fill("0");
    stretch[0]               = "1e-3*x";
    const unsigned int  n    = 8;
    const auto          mesh = make_cube<dim>(n);
    const ErrorEstimate read = estimate_of<dim>(*mesh, stretch, {});
    const auto          C    = solid<dim>().stiffness();
    const double        h = 1. / n, share = C[0][0][1][1] / C[0][0][0][0];
    const double        sides = 2. * (1. + (dim - 1) * share * share);
    // At the nodes the squares are h^2/12 less.
    const double square = 1. / 3. - h * h / 12.;
    EXPECT_NEAR(read.smooth + read.rough, std::sqrt(1. - 0.25 / square) * sides * h / 3., 1e-9);
    EXPECT_NEAR(read.surface, 0.25 * std::sqrt(sides * h * h * h / square), 1e-9);
    expect_sum_of_cells(read);
    // Cells at the surface have all of it.
    unsigned int n_inside = 0;
    for (const double of_cell : read.of_cells)
      n_inside += of_cell < 1e-12 ? 1 : 0;
    EXPECT_EQ(dealii::Utilities::MPI::sum(n_inside, MPI_COMM_WORLD),
              dealii::Utilities::fixed_power<dim>(n - 2));
  }

  /// Jumps of cubic displacements store h^4, gaps to what is prescribed take h^3.5.
  template <int dim>
  void expect_orders()
  {
    std::array<std::string, dim> cubic;
    cubic.fill("0");
    cubic[0]                   = "x^3 - x*y^2";
    const ErrorEstimate coarse = estimate_of<dim>(*make_cube<dim>(6), cubic, all_sides<dim>());
    const ErrorEstimate fine   = estimate_of<dim>(*make_cube<dim>(12), cubic, all_sides<dim>());
    EXPECT_NEAR(std::log2((coarse.smooth + coarse.rough) / (fine.smooth + fine.rough)), 4., 0.5);
    EXPECT_NEAR(std::log2(coarse.surface / fine.surface), 3.5, 0.3);
    EXPECT_GT(coarse.total(), 1e-3);
    expect_sum_of_cells(coarse);
  }
} // namespace

TEST(ErrorEstimate, QuadraticFieldsHaveNone2D)
{
  expect_no_error_of_quadratic_fields<2>();
}

TEST(ErrorEstimate, QuadraticFieldsHaveNone3D)
{
  expect_no_error_of_quadratic_fields<3>();
}

TEST(ErrorEstimate, MissingTractionsCount)
{
  expect_missing_tractions<2>();
  expect_missing_tractions<3>();
}

TEST(ErrorEstimate, FallsWithTheOrderOfItsParts)
{
  expect_orders<2>();
  expect_orders<3>();
}

TEST(ErrorEstimate, FindsTheCellsOfAnError)
{
  ErrorEstimate estimate;
  estimate.smooth = 0.01;
  EXPECT_NEAR(estimate.factor_for(0.01 / 16.), 0.5, 1e-3);
  EXPECT_NEAR(estimate.factor_for(0.16), 2., 4e-3);
  estimate         = {};
  estimate.surface = 0.01;
  EXPECT_NEAR(estimate.factor_for(0.01 * std::pow(2., -3.5)), 0.5, 1e-3);
  // Corners promise less with finer cells, and allow no more with coarser ones.
  estimate       = {};
  estimate.rough = 0.01;
  EXPECT_NEAR(estimate.factor_for(0.01 * std::pow(2., -1.2)), 0.5, 1e-3);
  EXPECT_NEAR(estimate.factor_for(0.16), 2., 4e-3);
}
