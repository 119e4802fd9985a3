// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/bond_based.h>
#include <perideal/operators/linear/gauss_operator.h>
#include <perideal/operators/system/assembled_matrix.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>
#include <functional>

using namespace perideal;

namespace
{
  template <int dim>
  struct GaussBody
  {
    GaussBody(const Mesh<dim> &mesh, const unsigned int n, const double horizon_factor = 2.2)
      : body(mesh, horizon_factor, "sphere", "gauss points")
      , points(std::make_shared<GaussPoints<dim>>(mesh, body.nodes, *body.families, n))
    {
      points->fit(body.nodes, 3.);
      std::vector<double> modulus;
      for (const double horizon : body.families->horizon)
        modulus.push_back(BondBased<dim>::micromodulus(1., horizon, 1.));
      bonds = std::make_shared<GaussOperator<dim>>(body.families, points, modulus, Stiffening());
      bonds->initialize(displacement);
      bonds->initialize(force);
    }

    using Field = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

    const NodalVector &force_of(const Field &field)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        {
          const auto value = field(body.nodes.position[i]);
          for (int d = 0; d < dim; ++d)
            displacement.local_element(dim * i + d) = value[d];
        }
      bonds->vmult(force, displacement);
      return force;
    }

    test::Body<dim>                     body;
    std::shared_ptr<GaussPoints<dim>>   points;
    std::shared_ptr<GaussOperator<dim>> bonds;
    NodalVector                         displacement, force;
  };

  template <int dim>
  dealii::Tensor<1, dim> rough(const dealii::Point<dim> &x)
  {
    dealii::Tensor<1, dim> value;
    for (int d = 0; d < dim; ++d)
      value[d] = test::scatter(x, d);
    return value;
  }

  /// Points carry the volume of the body, stand in their cells and know quadratic fields, on any rank.
  template <int dim>
  void expect_points_of_cells(const Mesh<dim> &mesh)
  {
    for (const unsigned int n : {1u, 2u, 3u})
      {
        GaussBody<dim> gauss(mesh, n);
        const auto    &nodes    = gauss.body.nodes;
        const auto    &families = *gauss.body.families;
        NodalVector    at_points;
        gauss.points->initialize(at_points);
        const auto quadratic = [](const auto &x) {
          dealii::Tensor<1, dim> value;
          value[0]       = 1. + x[0] - x[1] * x[dim - 1];
          value[dim - 1] = x[1] * x[1] - 2. * x[0];
          return value;
        };
        gauss.force_of(quadratic);
        gauss.points->interpolate(gauss.displacement, at_points);
        const unsigned int n_points = gauss.points->n_points();
        for (LocalIndex j = 0; j < families.n_local(); ++j)
          {
            double             volume = 0;
            dealii::Point<dim> centroid;
            for (unsigned int g = 0; g < n_points; ++g)
              {
                dealii::Point<dim> x;
                for (int d = 0; d < dim; ++d)
                  x[d] = gauss.points->coordinate(j, d)[g];
                volume += gauss.points->volume(j)[g];
                centroid += gauss.points->volume(j)[g] * x;
                for (int d = 0; d < dim; ++d)
                  EXPECT_NEAR(at_points.local_element((dim * j + d) * n_points + g), quadratic(x)[d], 1e-11);
              }
            if (n > 1)
              {
                EXPECT_NEAR(volume, families.volume[j], 1e-13);
                EXPECT_LT((centroid / volume).distance(families.position[j]), 1e-12);
              }
          }
        EXPECT_EQ(nodes.size(), families.n_owned());
      }
  }

  /// The matrix behind vmult() is the one that assemble() and jacobi_blocks() say.
  template <int dim>
  void expect_one_matrix(const Mesh<dim> &mesh)
  {
    GaussBody<dim>                         gauss(mesh, 2);
    const ConstrainedOperator<dim>         system(gauss.bonds,
                                          std::make_shared<MirrorLayer<dim>>(gauss.body.nodes),
                                          gauss.body.nodes,
                                          std::vector<std::uint8_t>(dim * gauss.body.nodes.size(), 0));
    dealii::TrilinosWrappers::SparseMatrix matrix;
    assemble_matrix(system, matrix);
    gauss.force_of([](const auto &x) { return rough<dim>(x); });
    NodalVector product;
    system.initialize(product);
    NodalVector source;
    system.initialize(source);
    std::copy(
      gauss.displacement.begin(), gauss.displacement.begin() + source.locally_owned_size(), source.begin());
    matrix.vmult(product, source);
    const double scale = product.linfty_norm();
    for (std::size_t k = 0; k < product.locally_owned_size(); ++k)
      ASSERT_NEAR(product.local_element(k), gauss.force.local_element(k), 1e-12 * scale);

    const auto blocks = gauss.bonds->jacobi_blocks();
    const auto first  = product.get_partitioner()->local_range().first;
    for (LocalIndex i = 0; i < blocks.size(); ++i)
      for (int a = 0; a < dim; ++a)
        for (int b = 0; b < dim; ++b)
          ASSERT_NEAR(blocks[i][a][b],
                      matrix.el(first + dim * i + a, first + dim * i + b),
                      1e-12 * matrix.linfty_norm());
  }
} // namespace

TEST(GaussPoints, FillTheirCellsInTwoDimensions)
{
  expect_points_of_cells<2>(*test::make_box<2>({8, 7}, {1., 1.}, 0.3));
}

TEST(GaussPoints, FillTheirCellsInThreeDimensions)
{
  expect_points_of_cells<3>(*test::make_box<3>({5, 5, 4}, {1., 1., 0.8}, 0.25));
}

TEST(GaussPoints, NeedSupportsOfThreeCellsAcross)
{
  const auto          mesh = test::make_box<2>({9, 2}, {1., 0.2}, 0.);
  const test::Body<2> body(*mesh, 2.2, "sphere", "gauss points");
  test::expect_input_error([&] { GaussPoints<2>(*mesh, body.nodes, *body.families, 2).fit(body.nodes, 3.); },
                           {"Quadrature/Support radius", "general position"});
}

TEST(GaussOperator, AssemblesWhatItMultiplies)
{
  expect_one_matrix<2>(*test::make_box<2>({7, 6}, {1., 1.}, 0.3));
  expect_one_matrix<3>(*test::make_box<3>({4, 4, 3}, {1., 1., 0.75}, 0.2));
}

TEST(GaussOperator, RigidMotionsNeedNoForce)
{
  // Displacements at points are exact for linear fields, so that only round-off is left.
  GaussBody<2> gauss(*test::make_box<2>({7, 6}, {1., 0.9}, 0.3), 2);
  const double scale = gauss.force_of([](const auto &x) { return rough<2>(x); }).linfty_norm();
  EXPECT_LT(
    gauss.force_of([](const auto &x) {
           return dealii::Tensor<1, 2>({0.3 - 0.7 * x[1], -0.2 + 0.7 * x[0]});
         })
      .linfty_norm(),
    1e-12 * scale);
}

TEST(GaussOperator, UniformStrainIsInEquilibriumInsideRegularMeshes)
{
  const auto   mesh = test::make_box<3>({7, 7, 7}, {1., 1., 1.}, 0.);
  GaussBody<3> gauss(*mesh, 2, 2.);
  const double scale = gauss.force_of([](const auto &x) { return rough<3>(x); }).linfty_norm();
  gauss.force_of([](const auto &x) {
    return dealii::Tensor<1, 3>({0.3 * x[0] + 0.1 * x[1], -0.2 * x[1], 0.1 * x[2] - 0.4 * x[0]});
  });
  double inside = 0, at_surface = 0;
  for (LocalIndex i = 0; i < gauss.body.nodes.size(); ++i)
    for (int d = 0; d < 3; ++d)
      {
        bool is_inside = true;
        for (int e = 0; e < 3; ++e)
          is_inside &= std::abs(gauss.body.nodes.position[i][e] - 0.5) < 0.01;
        double &largest = is_inside ? inside : at_surface;
        largest         = std::max(largest, std::abs(gauss.force.local_element(3 * i + d)));
      }
  inside     = dealii::Utilities::MPI::max(inside, MPI_COMM_WORLD);
  at_surface = dealii::Utilities::MPI::max(at_surface, MPI_COMM_WORLD);
  EXPECT_LT(inside, 1e-13 * scale);
  EXPECT_GT(at_surface, 1e-3 * scale);
}

TEST(GaussOperator, FirstMomentsComeNearThoseOfTheSphere)
{
  // int |xi| dV = pi d^4: the error of the cut points falls with their number.
  const auto mesh    = test::make_box<3>({9, 9, 9}, {9., 9., 9.}, 0.);
  double     error_1 = 0;
  for (const unsigned int n : {1u, 2u, 3u})
    {
      const GaussBody<3> gauss(*mesh, n, 3.);
      double             error = 0;
      for (LocalIndex i = 0; i < gauss.body.nodes.size(); ++i)
        if (gauss.body.nodes.position[i].distance(dealii::Point<3>(4.5, 4.5, 4.5)) < 0.1)
          error =
            std::abs(first_moment(*gauss.body.families, *gauss.points, i) / (dealii::numbers::PI * 81.) - 1.);
      error = dealii::Utilities::MPI::max(error, MPI_COMM_WORLD);
      if (n == 1)
        error_1 = error;
      else
        EXPECT_LT(error, 0.5 * error_1) << n;
    }
  EXPECT_LT(error_1, 0.1);
}
