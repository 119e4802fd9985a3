// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/linear/consistent_operator.h>
#include <perideal/operators/linear/surface_cure.h>
#include <perideal/operators/system/assembled_matrix.h>
#include <perideal/operators/system/constrained_operator.h>
#include <perideal/parameters/elastic_constants.h>

#include <deal.II/grid/grid_tools.h>

#include "bodies.h"
#include "moments.h"
#include "near_blocks.h"
#include "springs.h"
#include "testing.h"

#include <Eigen/Eigenvalues>

#include <functional>

using namespace perideal;

namespace
{
  struct Variant
  {
    std::string     model, form;
    PlaneAssumption assumption;
    double          poisson_ratio;
    /// With a notch, and values in the place of means.
    bool is_notched = false;
  };

  /// A notch from the left side into a box.
  template <int dim>
  bool crosses_notch(const double height, const dealii::Point<dim> &a, const dealii::Point<dim> &b)
  {
    const double depth = 0.5;
    if ((a[1] > height) == (b[1] > height))
      return false;
    const double share = (height - a[1]) / (b[1] - a[1]);
    return a[0] + share * (b[0] - a[0]) < depth;
  }

  /// Every model in every state it is offered for.
  template <int dim>
  std::vector<Variant> variants()
  {
    std::vector<Variant> result;
    for (const auto &model : test::list_bond_models(false))
      if (dim == 3)
        for (const double nu : {0.1, 0.33})
          result.push_back({model.first, model.second, PlaneAssumption::solid, nu});
      else
        for (const auto assumption : {PlaneAssumption::plane_stress, PlaneAssumption::plane_strain})
          result.push_back({model.first, model.second, assumption, 0.3});
    result.push_back({"extended ordinary",
                      "consistent",
                      dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain,
                      0.3,
                      true});
    return result;
  }

  /// A body with its operator, nothing held.
  template <int dim>
  struct FreeBody
  {
    FreeBody(const Mesh<dim> &mesh, const Variant &variant)
      : variant(variant)
      , body(mesh)
      , constants{70e9, variant.poisson_ratio, variant.assumption}
    {
      ModelParameters parameters;
      parameters.model = variant.model;
      parameters.form  = variant.form;
      parameters.resolve(dim);
      const auto solid_of = [&](const dealii::types::material_id) {
        const ElasticConstants own = parameters.constants_of_model(constants);
        return ElasticSolid<dim>(own);
      };
      BondPredicate<dim> is_cut;
      if (variant.is_notched)
        // Two layers of cells or more on either side.
        is_cut = [height = 0.47 * dealii::GridTools::compute_bounding_box(mesh.triangulation).side_length(1)](
                   const auto &a, const auto &b) { return crosses_notch<dim>(height, a, b); };
      if (parameters.is_consistent())
        bonds = test::make_consistent_operator<dim>(
          body.families,
          test::make_moments(mesh,
                             body.nodes,
                             std::make_shared<const FaceValues<dim>>(),
                             is_cut,
                             variant.is_notched ? CellUnknown::value : CellUnknown::mean),
          create_consistent<dim>(parameters, 3.01),
          solid_of,
          is_cut);
      else
        bonds = create_bond_operator<dim>(body.families, *create_model<dim>(parameters, 1.), solid_of);
      if (parameters.has_surface_cure())
        bonds = std::make_shared<SurfaceCure<dim>>(
          bonds,
          std::make_shared<const FaceGradient<dim>>(mesh, body.nodes, [](const auto) { return 1.; }),
          body.nodes.volume,
          solid_of);
      resists_rotation = parameters.is_tensor_involved() && !parameters.is_consistent();
      mirror           = std::make_shared<MirrorLayer<dim>>(body.nodes);
      bonds->initialize(force);
      bonds->initialize(displacement);
    }

    ConstrainedOperator<dim> system() const
    {
      return ConstrainedOperator<dim>(
        bonds, mirror, body.nodes, std::vector<std::uint8_t>(dim * body.nodes.size(), 0));
    }

    /// Force under a displacement given as a function of position.
    const NodalVector &
    force_of(const std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)> &function)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        {
          const auto value = function(body.nodes.position[i]);
          for (int d = 0; d < dim; ++d)
            displacement.local_element(dim * i + d) = value[d];
        }
      bonds->vmult(force, displacement);
      return force;
    }

    /// A displacement without pattern, of the size of its argument.
    static dealii::Tensor<1, dim> rough(const dealii::Point<dim> &point, const unsigned int seed)
    {
      dealii::Tensor<1, dim> value;
      for (int d = 0; d < dim; ++d)
        value[d] = 1e-3 * test::scatter(point, 5 * seed + d);
      return value;
    }

    Variant                            variant;
    test::Body<dim>                    body;
    ElasticConstants                   constants;
    std::shared_ptr<BondOperator<dim>> bonds;
    std::shared_ptr<MirrorLayer<dim>>  mirror;
    NodalVector                        force, displacement;
    /// Bonds that pull sideways feel rotations and have moments.
    bool resists_rotation;
  };

  /// Runs a property over all bodies and variants.
  template <int dim>
  void for_all(const std::function<void(FreeBody<dim> &)> &property)
  {
    for (const auto &mesh : test::make_boxes<dim>())
      for (const Variant &variant : variants<dim>())
        {
          SCOPED_TRACE(variant.model + ", " + variant.form + ", nu = " +
                       std::to_string(variant.poisson_ratio) + (variant.is_notched ? ", notched" : ""));
          FreeBody<dim> free_body(*mesh, variant);
          property(free_body);
        }
  }

  template <int dim>
  Eigen::MatrixXd dense_matrix(const FreeBody<dim> &free_body)
  {
    const Eigen::Index n      = dim * free_body.body.nodes.size();
    Eigen::MatrixXd    result = Eigen::MatrixXd::Zero(n, n);
    free_body.bonds->assemble(
      [&](const std::vector<GlobalIndex> &unknowns, const std::vector<double> &values) {
        for (std::size_t r = 0; r < unknowns.size(); ++r)
          for (std::size_t c = 0; c < unknowns.size(); ++c)
            result(unknowns[r], unknowns[c]) += values[r * unknowns.size() + c];
      });
    return result;
  }

  template <int dim>
  void expect_invariants()
  {
    for_all<dim>([](FreeBody<dim> &free_body) {
      const double size =
        free_body.force_of([](const dealii::Point<dim> &x) { return FreeBody<dim>::rough(x, 1); })
          .linfty_norm();
      ASSERT_GT(size, 0.);

      // Momentum and angular momentum balance in any motion.
      dealii::Tensor<1, dim> resultant;
      double                 moment = 0;
      for (LocalIndex i = 0; i < free_body.body.nodes.size(); ++i)
        {
          dealii::Tensor<1, dim> f;
          for (int d = 0; d < dim; ++d)
            f[d] = free_body.force.local_element(dim * i + d);
          resultant += f;
          const auto &x = free_body.body.nodes.position[i];
          moment += x[0] * f[1] - x[1] * f[0];
        }
      EXPECT_LE(dealii::Utilities::MPI::sum(resultant, MPI_COMM_WORLD).norm(), 1e-12 * size);
      moment = dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD);
      EXPECT_LE(free_body.resists_rotation ? 0. : std::abs(moment), 1e-12 * size);

      // No force at rest, under translation and under small rotation.
      EXPECT_EQ(
        free_body.force_of([](const dealii::Point<dim> &) { return dealii::Tensor<1, dim>(); }).linfty_norm(),
        0.);
      const auto translated = [](const dealii::Point<dim> &) {
        dealii::Tensor<1, dim> value;
        for (int d = 0; d < dim; ++d)
          value[d] = 1e-3 * (d + 1);
        return value;
      };
      EXPECT_LE(free_body.force_of(translated).linfty_norm(), 1e-12 * size);
      const auto turned = [](const dealii::Point<dim> &x) {
        dealii::Tensor<1, dim> value;
        value[0] = -1e-3 * x[1];
        value[1] = 1e-3 * x[0];
        return value;
      };
      if (free_body.resists_rotation)
        EXPECT_GE(free_body.force_of(turned).linfty_norm(), 1e-6 * size);
      else
        EXPECT_LE(free_body.force_of(turned).linfty_norm(), 1e-12 * size);
    });
  }

  template <int dim>
  void expect_symmetry_where_claimed()
  {
    for_all<dim>([](FreeBody<dim> &free_body) {
      free_body.force_of([](const dealii::Point<dim> &x) { return FreeBody<dim>::rough(x, 1); });
      const NodalVector first = free_body.displacement, force_of_first = free_body.force;
      free_body.force_of([](const dealii::Point<dim> &x) { return FreeBody<dim>::rough(x, 2); });
      const double ab = free_body.displacement * force_of_first, ba = first * free_body.force;
      const double size = force_of_first.l2_norm() * first.l2_norm();
      if (free_body.bonds->is_symmetric())
        EXPECT_NEAR(ab, ba, 1e-13 * size);
      else
        EXPECT_GT(std::abs(ab - ba), 1e-9 * size) << "the model could claim symmetry";
    });
  }

  /// The force on a body must not depend on how it is divided among ranks.
  template <int dim>
  void expect_rank_independence()
  {
    const auto shared = test::make_boxes<dim>(), alone = test::make_boxes<dim>(MPI_COMM_SELF);
    for (std::size_t b = 0; b < shared.size(); ++b)
      for (const Variant &variant : variants<dim>())
        {
          FreeBody<dim> divided(*shared[b], variant), whole(*alone[b], variant);
          const auto    rough = [](const dealii::Point<dim> &x) { return FreeBody<dim>::rough(x, 3); };
          divided.force_of(rough);
          whole.force_of(rough);
          EXPECT_EQ(divided.bonds->counts.fallback, whole.bonds->counts.fallback);
          EXPECT_EQ(divided.bonds->counts.singular, whole.bonds->counts.singular);
          const auto   divided_blocks = divided.bonds->jacobi_blocks(), blocks = whole.bonds->jacobi_blocks();
          const double size = whole.force.linfty_norm();
          for (LocalIndex i = 0; i < divided.body.nodes.size(); ++i)
            for (LocalIndex j = 0; j < whole.body.nodes.size(); ++j)
              if (divided.body.nodes.position[i].distance(whole.body.nodes.position[j]) < 1e-12)
                {
                  for (int d = 0; d < dim; ++d)
                    EXPECT_NEAR(divided.force.local_element(dim * i + d),
                                whole.force.local_element(dim * j + d),
                                1e-12 * size);
                  EXPECT_LE((divided_blocks[i] - blocks[j]).norm(), 1e-12 * blocks[j].norm());
                }
        }
  }

  template <int dim>
  void expect_matrix_forms_agree()
  {
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      return;
    for_all<dim>([](FreeBody<dim> &free_body) {
      const Eigen::MatrixXd matrix = dense_matrix(free_body);
      free_body.force_of([](const dealii::Point<dim> &x) { return FreeBody<dim>::rough(x, 4); });
      const Eigen::Map<const Eigen::VectorXd> u(free_body.displacement.begin(), matrix.rows());
      const Eigen::Map<const Eigen::VectorXd> f(free_body.force.begin(), matrix.rows());
      EXPECT_LE((matrix * u - f).norm(), 1e-12 * f.norm());
      const auto blocks = free_body.bonds->jacobi_blocks();
      for (LocalIndex i = 0; i < blocks.size(); ++i)
        {
          dealii::Tensor<2, dim> of_diagonal;
          for (int r = 0; r < dim; ++r)
            for (int c = 0; c < dim; ++c)
              of_diagonal[r][c] = matrix(dim * i + r, dim * i + c);
          if (free_body.variant.form == "consistent")
            test::expect_preconditions(blocks[i], of_diagonal);
          else
            {
              EXPECT_LE((blocks[i] - of_diagonal).norm(), 1e-12 * blocks[i].norm());
            }
        }
    });
  }

  /// Energy and consistent form: no negative eigenvalue, and none zero beyond the rigid-body motions.
  template <int dim>
  void expect_spectrum()
  {
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      return;
    for_all<dim>([](FreeBody<dim> &free_body) {
      // The ordinary model below nu = 1/4 takes energy away with the dilatation,
      // which families that are not spherical do not give back.
      // Bonds with tensors may push sideways; their spectrum has a test of its own.
      if (!free_body.bonds->is_symmetric() || free_body.resists_rotation ||
          (free_body.variant.model == "ordinary" && free_body.variant.poisson_ratio < 0.25))
        return;
      const Eigen::MatrixXd                                matrix = dense_matrix(free_body);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix, Eigen::EigenvaluesOnly);
      const double                                         largest = eigen.eigenvalues().maxCoeff();
      constexpr Eigen::Index                               n_rigid = dim * (dim + 1) / 2;
      EXPECT_GE(eigen.eigenvalues()[0], -1e-12 * largest);
      EXPECT_LE(eigen.eigenvalues()[n_rigid - 1], 1e-12 * largest);
      EXPECT_GE(eigen.eigenvalues()[n_rigid], 1e-6 * largest);
    });
  }
} // namespace

TEST(BondOperator, Invariants2D)
{
  expect_invariants<2>();
}
TEST(BondOperator, Invariants3D)
{
  expect_invariants<3>();
}
TEST(BondOperator, SymmetryWhereClaimed2D)
{
  expect_symmetry_where_claimed<2>();
}
TEST(BondOperator, SymmetryWhereClaimed3D)
{
  expect_symmetry_where_claimed<3>();
}
TEST(BondOperator, SameOnAnyNumberOfRanks2D)
{
  expect_rank_independence<2>();
}
TEST(BondOperator, SameOnAnyNumberOfRanks3D)
{
  expect_rank_independence<3>();
}
TEST(BondOperator, MatrixDiagonalAndProductAgree2D)
{
  expect_matrix_forms_agree<2>();
}
TEST(BondOperator, MatrixDiagonalAndProductAgree3D)
{
  expect_matrix_forms_agree<3>();
}
TEST(BondOperator, Spectrum2D)
{
  expect_spectrum<2>();
}
TEST(BondOperator, Spectrum3D)
{
  expect_spectrum<3>();
}

/// Where no bond pushes sideways (plane stress, nu < 1/3) nothing but translations is free of energy.
TEST(BondOperator, SpectrumOfTensorBonds)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  for (const auto &mesh : test::make_boxes<2>())
    {
      FreeBody<2> free_body(*mesh, {"tensor involved", "one point", PlaneAssumption::plane_stress, 0.22});
      const Eigen::MatrixXd                                matrix = dense_matrix(free_body);
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix, Eigen::EigenvaluesOnly);
      const double                                         largest = eigen.eigenvalues().maxCoeff();
      EXPECT_GE(eigen.eigenvalues()[0], -1e-12 * largest);
      EXPECT_LE(eigen.eigenvalues()[1], 1e-12 * largest);
      EXPECT_GE(eigen.eigenvalues()[2], 1e-6 * largest);
    }
}

/// Rotation of a regular body: what the bonds resist with, C - S, does no work inside, and its energy is
/// (mu - lambda)/2 w^2 of each volume as the moments of its family tell it; the surface cure takes it away.
TEST(BondOperator, TensorBondsResistRotationAtSurfacesOnly)
{
  const auto mesh = test::make_box<2>({14, 14}, {1.4, 1.4}, 0.);
  const auto turn = [](const dealii::Point<2> &x) {
    return dealii::Tensor<1, 2>(dealii::Point<2>(-1e-3 * x[1], 1e-3 * x[0]));
  };
  FreeBody<2> bonds(*mesh, {"tensor involved", "moment corrected", PlaneAssumption::plane_stress, 0.22});
  FreeBody<2> cured(*mesh, {"tensor involved", "surface cure", PlaneAssumption::plane_stress, 0.22});
  const NodalVector force = bonds.force_of(turn);
  const double      size  = dealii::Utilities::MPI::max(force.linfty_norm(), MPI_COMM_WORLD);
  ASSERT_GT(size, 0.);
  for (LocalIndex i = 0; i < bonds.body.nodes.size(); ++i)
    {
      // Deeper than twice the horizon every bond has two whole families.
      const auto  &x     = bonds.body.nodes.position[i];
      const double depth = std::min({x[0], 1.4 - x[0], x[1], 1.4 - x[1]});
      for (int d = 0; d < 2; ++d)
        EXPECT_NEAR(depth > 0.61 ? force.local_element(2 * i + d) : 0., 0., 1e-12 * size);
    }
  const double energy = 0.5 * (bonds.displacement * force);
  const double expected =
    0.5 * (bonds.constants.shear_modulus() - bonds.constants.lame_lambda()) * 1e-6 * 1.96;
  EXPECT_NEAR(energy, expected, 1e-10 * expected);
  const double left = 0.5 * (cured.displacement * cured.force_of(turn));
  EXPECT_LE(std::abs(left), 1e-10 * expected);
}

TEST(BondOperator, UniformStrainStoresTheContinuumsEnergy)
{
  // u.K u/2 of the energy form is sum V W, exact where no family is singular.
  // An annulus has no corners, whose quarter discs have no non-negative weights.
  Mesh<2> annulus(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_shell(annulus.triangulation, {0.1, 0.2}, 0.4, 1., 12);
  annulus.triangulation.refine_global(3);
  FreeBody<2> free_body(annulus, {"extended ordinary", "energy", PlaneAssumption::plane_strain, 0.2});
  ASSERT_EQ(free_body.bonds->counts.singular, 0u);

  dealii::SymmetricTensor<2, 2> strain;
  strain[0][0] = 1e-3;
  strain[1][1] = -4e-4;
  strain[0][1] = 7e-4;
  free_body.force_of([&](const dealii::Point<2> &x) { return strain * x; });
  double volume = 0;
  for (const double v : free_body.body.nodes.volume)
    volume += v;
  volume             = dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD);
  const double exact = volume * (0.5 * free_body.constants.bulk_modulus() * trace(strain) * trace(strain) +
                                 free_body.constants.shear_modulus() * std::pow(deviator(strain).norm(), 2));
  EXPECT_NEAR(0.5 * (free_body.displacement * free_body.force), exact, 1e-11 * exact);
}

TEST(AssembledMatrix, EqualsTheConstrainedOperator)
{
  const auto  mesh = test::make_box<2>({8, 7}, {1., 1.}, 0.3);
  FreeBody<2> free_body(*mesh, {"extended ordinary", "paper", PlaneAssumption::plane_stress, 0.3});
  std::vector<std::uint8_t> held(2 * free_body.body.nodes.size(), 0);
  for (LocalIndex i = 0; i < free_body.body.nodes.size(); ++i)
    held[2 * i] = free_body.body.nodes.position[i][0] < 0.2;
  const ConstrainedOperator<2> system(free_body.bonds, free_body.mirror, free_body.body.nodes, held);
  dealii::TrilinosWrappers::SparseMatrix matrix;
  assemble_matrix(system, matrix);
  NodalVector x, expected, found;
  for (NodalVector *vector : {&x, &expected, &found})
    system.initialize(*vector);
  for (LocalIndex i = 0; i < held.size(); ++i)
    x.local_element(i) = held[i] ? 0. : test::scatter(free_body.body.nodes.position[i / 2], i % 2);
  system.vmult(expected, x);
  matrix.vmult(found, x);
  found -= expected;
  EXPECT_LE(found.l2_norm(), 1e-12 * expected.l2_norm());
}
