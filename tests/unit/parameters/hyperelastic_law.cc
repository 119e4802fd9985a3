// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/hyperelastic_law.h>

#include <deal.II/physics/elasticity/kinematics.h>

#include "testing.h"

#include <cmath>
#include <random>

using namespace perideal;
using test::expect_input_error;

namespace
{
  template <int dim>
  using Gradient = dealii::Tensor<2, dim>;

  constexpr double E = 70e9, nu = 0.33;

  template <int dim>
  std::vector<ElasticConstants> all_constants()
  {
    if (dim == 3)
      return {{E, nu, PlaneAssumption::solid}, {E, -0.2, PlaneAssumption::solid}};
    return {{E, nu, PlaneAssumption::plane_stress},
            {E, -0.2, PlaneAssumption::plane_stress},
            {E, nu, PlaneAssumption::plane_strain}};
  }

  /// Gradients with entries up to 0.3, rotations among them.
  template <int dim>
  std::vector<Gradient<dim>> gradients()
  {
    std::mt19937                           random(7);
    std::uniform_real_distribution<double> entry(-0.3, 0.3);
    std::vector<Gradient<dim>>             result(5);
    for (auto &H : result)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j)
          H[i][j] = entry(random);
    return result;
  }

  template <int dim, typename Check>
  void for_all_laws(const Check &check)
  {
    for (const std::string &name : LawChoice::list().names())
      for (const auto &constants : all_constants<dim>())
        {
          SCOPED_TRACE(name + ", nu = " + std::to_string(constants.poisson_ratio));
          check(*create_law<dim>(name, ElasticSolid<dim>(constants)), constants);
        }
  }

  template <int dim>
  void expect_derivatives()
  {
    constexpr double step = 1e-5;
    for_all_laws<dim>([](const auto &law, const auto &) {
      for (const Gradient<dim> &H : gradients<dim>())
        for (int k = 0; k < dim; ++k)
          for (int l = 0; l < dim; ++l)
            {
              Gradient<dim> more = H, less = H;
              more[k][l] += step;
              less[k][l] -= step;
              // Central differences, to the square of the step.
              EXPECT_NEAR(law.stress(H)[k][l], (law.energy(more) - law.energy(less)) / (2 * step), 1e-8 * E);
              const auto difference = (law.stress(more) - law.stress(less)) / (2 * step);
              const auto tangent    = law.tangent(H);
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j)
                  {
                    EXPECT_NEAR(tangent[i][j][k][l], difference[i][j], 1e-8 * E);
                    EXPECT_NEAR(tangent[i][j][k][l], tangent[k][l][i][j], 1e-12 * E);
                  }
            }
    });
  }

  template <int dim>
  void expect_linear_elasticity_at_rest()
  {
    for_all_laws<dim>([](const auto &law, const auto &constants) {
      const ElasticSolid<dim>      solid(constants);
      const dealii::Tensor<4, dim> C = solid.stiffness();
      EXPECT_NEAR((law.tangent(Gradient<dim>()) - C).norm(), 0., 1e-12 * E);
      EXPECT_NEAR(law.stress(Gradient<dim>()).norm(), 0., 1e-12 * E);
      EXPECT_NEAR(law.energy(Gradient<dim>()), 0., 1e-12 * E);
      EXPECT_NEAR(law.thickness_stretch(Gradient<dim>()), 1., 1e-12);
      // Small strains: the Cauchy stress is that of Hooke's law in space.
      Gradient<dim> H;
      H[0][0]             = 3e-7;
      H[1][1]             = -1e-7;
      H[0][1]             = 2e-7;
      const auto expected = solid.stiffness_in_space() * solid.strain_in_space(dealii::symmetrize(H));
      EXPECT_NEAR((law.cauchy_stress(H) - expected).norm(), 0., 1e-6 * expected.norm());
    });
  }
} // namespace

TEST(HyperelasticLaw, StressAndTangentAreDerivatives)
{
  expect_derivatives<2>();
  expect_derivatives<3>();
}

TEST(HyperelasticLaw, IsLinearElasticityAtRest)
{
  expect_linear_elasticity_at_rest<2>();
  expect_linear_elasticity_at_rest<3>();
}

TEST(HyperelasticLaw, CauchyStressIsThatOfTheFirstPiolaKirchhoffStress)
{
  const auto check = [](const auto &law, const auto &H, const double volume) {
    const auto F      = dealii::Physics::Elasticity::Kinematics::F(H);
    const auto cauchy = law.cauchy_stress(H);
    const auto pushed = law.stress(H) * transpose(F) / volume;
    for (unsigned int i = 0; i < H.dimension; ++i)
      for (unsigned int j = 0; j < H.dimension; ++j)
        EXPECT_NEAR(cauchy[i][j], pushed[i][j], 1e-10 * E);
  };
  for (const char *name : {"Saint Venant-Kirchhoff", "neo-Hookean", "Hencky"})
    {
      SCOPED_TRACE(name);
      for (const auto &constants : all_constants<2>())
        for (const auto &H : gradients<2>())
          {
            const auto   law       = create_law<2>(name, ElasticSolid<2>(constants));
            const double thickness = law->thickness_stretch(H);
            check(*law, H, thickness * determinant(dealii::Physics::Elasticity::Kinematics::F(H)));
            if (constants.assumption == PlaneAssumption::plane_stress)
              {
                EXPECT_NEAR(law->cauchy_stress(H)[2][2], 0., 1e-10 * E);
              }
          }
      for (const auto &constants : all_constants<3>())
        for (const auto &H : gradients<3>())
          check(*create_law<3>(name, ElasticSolid<3>(constants)),
                H,
                determinant(dealii::Physics::Elasticity::Kinematics::F(H)));
    }
}

TEST(HyperelasticLaw, PlaneStressIsThatOfTheThicknessItFinds)
{
  // The plane law is the one in space with the stretch across that leaves no stress there.
  for (const char *name : {"Saint Venant-Kirchhoff", "neo-Hookean", "Hencky"})
    for (const auto &H : gradients<2>())
      {
        const auto plane =
          create_law<2>(name, ElasticSolid<2>(ElasticConstants{E, nu, PlaneAssumption::plane_stress}));
        const auto solid =
          create_law<3>(name, ElasticSolid<3>(ElasticConstants{E, nu, PlaneAssumption::solid}));
        Gradient<3> in_space;
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            in_space[i][j] = H[i][j];
        in_space[2][2]    = plane->thickness_stretch(H) - 1.;
        const auto stress = solid->stress(in_space);
        EXPECT_NEAR(stress[2][2], 0., 1e-10 * E);
        EXPECT_NEAR(solid->energy(in_space), plane->energy(H), 1e-12 * E);
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            EXPECT_NEAR(stress[i][j], plane->stress(H)[i][j], 1e-10 * E);
      }
}

TEST(HyperelasticLaw, RotationsCostNothingWhereStrainsAreFinite)
{
  Gradient<2> H;
  H[0][0] = H[1][1] = std::cos(1.) - 1.;
  H[1][0]           = std::sin(1.);
  H[0][1]           = -H[1][0];
  const ElasticSolid<2> solid(ElasticConstants{E, nu, PlaneAssumption::plane_stress});
  EXPECT_NEAR(create_law<2>("Saint Venant-Kirchhoff", solid)->energy(H), 0., 1e-14 * E);
  EXPECT_NEAR(create_law<2>("neo-Hookean", solid)->energy(H), 0., 1e-14 * E);
  EXPECT_NEAR(create_law<2>("Hencky", solid)->energy(H), 0., 1e-14 * E);
  EXPECT_GT(create_law<2>("linear elastic", solid)->energy(H), 0.1 * E);
}

TEST(HyperelasticLaw, LogarithmsAdmitNoBodyPressedThroughItself)
{
  Gradient<2> H;
  H[0][0] = -1.5;
  for (const char *name : {"neo-Hookean", "Hencky"})
    for (const auto &constants : all_constants<2>())
      {
        const auto law = create_law<2>(name, ElasticSolid<2>(constants));
        EXPECT_TRUE(std::isinf(law->energy(H)));
        EXPECT_TRUE(std::isnan(law->stress(H)[0][0]));
      }
}

TEST(HyperelasticLaw, HenckysStressIsLinearInTheLogarithmOfAStretch)
{
  // A bar pulled to twice its length or pressed to a half, free across: tau = E ln(stretch), nu of
  // logarithms.
  for (const double stretch : {2., 0.5})
    {
      Gradient<3> H;
      H[0][0] = stretch - 1.;
      H[1][1] = H[2][2] = std::pow(stretch, -nu) - 1.;
      const auto law =
        create_law<3>("Hencky", ElasticSolid<3>(ElasticConstants{E, nu, PlaneAssumption::solid}));
      const double J = std::pow(stretch, 1. - 2. * nu);
      EXPECT_NEAR(J * law->cauchy_stress(H)[0][0], E * std::log(stretch), 1e-12 * E);
      EXPECT_NEAR(law->cauchy_stress(H)[1][1], 0., 1e-12 * E);
    }
}

TEST(HyperelasticLaw, NamesWhatIsWrong)
{
  const ElasticSolid<2> isotropic(ElasticConstants{E, nu, PlaneAssumption::plane_stress});
  expect_input_error([&] { create_law<2>("neo Hookean", isotropic); }, {"neo-Hookean"});
  dealii::SymmetricTensor<4, 2> C = isotropic.stiffness();
  C[0][0][0][0] *= 2;
  expect_input_error([&] { create_law<2>("neo-Hookean", elastic_solid<2>(C)); }, {"isotropic"});
}
