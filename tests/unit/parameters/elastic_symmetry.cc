// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/material_parameters.h>
#include <perideal/parameters/parameter_file.h>

#include "solids.h"
#include "testing.h"

#include <sstream>

using namespace perideal;
using test::expect_input_error;

namespace
{
  using Stiffness = dealii::SymmetricTensor<4, 3>;
  // Graphite-epoxy.
  constexpr double E1 = 144.8e9, E2 = 11.7e9, nu12 = 0.21, G12 = 9.66e9, E3 = 9e9, nu13 = 0.3, nu23 = 0.4,
                   G13 = 6e9, G23 = 3e9;
  const std::string in_plane =
    "set Young moduli = 144.8e9, 11.7e9\n set Poisson ratios = 0.21\n set Shear moduli = 9.66e9\n";
  const std::string nine = "set Symmetry = orthotropic\n set Young moduli = 144.8e9, 11.7e9, 9e9\n"
                           "set Poisson ratios = 0.21, 0.3, 0.4\n set Shear moduli = 9.66e9, 6e9, 3e9\n";

  MaterialParameters read(const std::string &lines, const int dim)
  {
    const ParameterFile      file = ParameterFile::parse("subsection Material\n" + lines + "end\n", "a.prm");
    dealii::ParameterHandler prm;
    MaterialParameters       parameters;
    parameters.declare(prm, file);
    InputErrorCollector errors;
    file.apply(prm, errors);
    errors.raise();
    parameters.check(dim);
    return parameters;
  }

  template <int dim>
  ElasticSolid<dim> solid(const std::string &lines)
  {
    const auto parameters = read(lines, dim);
    return parameters.elastic_solid<dim>(parameters.body);
  }

  std::string turned(const std::string &angles)
  {
    return " set Orientation = " + angles + "\n";
  }

  const std::string strain_across = "set Assumption = plane strain\n";

  /// Equal to round-off of the inversion of the compliance.
  template <int dim>
  void expect_equal(const dealii::SymmetricTensor<4, dim> &a, const dealii::SymmetricTensor<4, dim> &b)
  {
    EXPECT_LE((a - b).norm(), 1e-13 * b.norm());
  }

  struct PlaneStiffness
  {
    double q11, q12, q22, q66;
  };

  /// Of the graphite-epoxy, by the theory of laminates.
  PlaneStiffness closed_form()
  {
    const double nu21 = nu12 * E2 / E1, below = 1. - nu12 * nu21;
    return {E1 / below, nu12 * E2 / below, E2 / below, G12};
  }

  std::string stiffness_text(const Stiffness &c)
  {
    const unsigned int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    std::ostringstream text;
    text.precision(17);
    text << "set Symmetry = anisotropic\n set Stiffness = ";
    for (int a = 0; a < 6; ++a)
      for (int b = a; b < 6; ++b)
        text << (a + b > 0 ? ", " : "") << c[pairs[a][0]][pairs[a][1]][pairs[b][0]][pairs[b][1]];
    return text.str() + "\n";
  }
} // namespace

TEST(ElasticSymmetry, OrthotropicStrainsAsTheConstantsSay)
{
  const auto                    c = solid<3>(nine);
  dealii::SymmetricTensor<2, 3> s, strain;
  s[0][0]      = 5e6;
  s[1][1]      = -2e6;
  s[2][2]      = 1e6;
  s[0][1]      = 3e6;
  s[0][2]      = -4e6;
  s[1][2]      = 7e6;
  strain[0][0] = s[0][0] / E1 - nu12 / E1 * s[1][1] - nu13 / E1 * s[2][2];
  strain[1][1] = s[1][1] / E2 - nu12 / E1 * s[0][0] - nu23 / E2 * s[2][2];
  strain[2][2] = s[2][2] / E3 - nu13 / E1 * s[0][0] - nu23 / E2 * s[1][1];
  strain[0][1] = s[0][1] / (2. * G12);
  strain[0][2] = s[0][2] / (2. * G13);
  strain[1][2] = s[1][2] / (2. * G23);
  EXPECT_LE((c.stiffness() * strain - s).norm(), 1e-13 * s.norm());
  EXPECT_FALSE(c.is_isotropic());
}

TEST(ElasticSymmetry, PlaneStressIsThatOfLaminates)
{
  const auto                    q = closed_form();
  dealii::SymmetricTensor<4, 2> exact;
  exact[0][0][0][0] = q.q11;
  exact[1][1][1][1] = q.q22;
  exact[0][0][1][1] = exact[1][1][0][0] = q.q12;
  exact[0][1][0][1]                     = q.q66;
  expect_equal(solid<2>(nine).stiffness(), exact);
  // What stands across the plane has no influence.
  for (const char *symmetry : {"orthotropic", "transversely isotropic"})
    expect_equal(solid<2>(std::string("set Symmetry = ") + symmetry + "\n" + in_plane).stiffness(), exact);
  expect_equal(solid<2>("set Symmetry = transversely isotropic\n set Young moduli = 144.8e9, 11.7e9\n"
                        "set Poisson ratios = 0.21, 0.5\n set Shear moduli = 9.66e9\n")
                 .stiffness(),
               exact);
}

TEST(ElasticSymmetry, PlaneStrainIsThePlaneOfTheSolid)
{
  const auto flat = solid<2>(strain_across + nine), in_space = solid<2>(nine);
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l)
          EXPECT_NEAR(flat.stiffness()[i][j][k][l], solid<3>(nine).stiffness()[i][j][k][l], 1e-3);
  EXPECT_GT(flat.stiffness()[0][0][0][0], 1.01 * in_space.stiffness()[0][0][0][0]);
}

TEST(ElasticSymmetry, IsotropicIsAmongTheOthers)
{
  const std::string moduli =
    "set Young moduli = 70e9\n set Poisson ratios = 0.25\n set Shear moduli = 28e9\n";
  const std::string twice =
    "set Young moduli = 70e9, 70e9\n set Poisson ratios = 0.25, 0.25\n set Shear moduli = 28e9\n";
  const std::string isotropic = "set Young modulus = 70e9\n set Poisson ratio = 0.25\n";
  for (const std::string &other : {"set Symmetry = cubic\n" + moduli,
                                   "set Symmetry = cubic\n" + moduli + turned("33"),
                                   "set Symmetry = transversely isotropic\n" + twice + turned("20")})
    {
      for (const std::string &assumption : {std::string(), strain_across})
        {
          const auto exact = solid<2>(assumption + isotropic), same = solid<2>(assumption + other);
          EXPECT_TRUE(same.is_isotropic());
          expect_equal(same.stiffness(), exact.stiffness());
          expect_equal(same.stiffness_in_space(), exact.stiffness_in_space());
          EXPECT_NEAR(same.isotropic().young_modulus, 70e9, 1e-2);
          EXPECT_NEAR(same.isotropic().poisson_ratio, 0.25, 1e-12);
        }
      EXPECT_TRUE(solid<3>(other).is_isotropic());
      expect_equal(solid<3>(other).stiffness(), solid<3>(isotropic).stiffness());
    }
  EXPECT_FALSE(solid<3>("set Symmetry = cubic\n set Young moduli = 70e9\n set Poisson ratios = 0.25\n"
                        "set Shear moduli = 30e9\n")
                 .is_isotropic());
}

TEST(ElasticSymmetry, FibresTurnFromXTowardsY)
{
  const auto   q     = closed_form();
  const double angle = dealii::numbers::PI / 6, c = std::cos(angle), s = std::sin(angle);
  for (const std::string &constants : {nine, "set Symmetry = orthotropic\n" + in_plane})
    {
      const auto result = solid<2>(constants + turned("30")).stiffness();
      EXPECT_NEAR(result[0][0][0][0],
                  q.q11 * std::pow(c, 4) + 2. * (q.q12 + 2. * q.q66) * s * s * c * c + q.q22 * std::pow(s, 4),
                  1e-13 * q.q11);
      EXPECT_NEAR(result[0][0][0][1],
                  (q.q11 - q.q12 - 2. * q.q66) * s * std::pow(c, 3) +
                    (q.q12 - q.q22 + 2. * q.q66) * std::pow(s, 3) * c,
                  1e-13 * q.q11);
      EXPECT_NEAR(result[0][1][0][1],
                  (q.q11 + q.q22 - 2. * q.q12 - 2. * q.q66) * s * s * c * c +
                    q.q66 * (std::pow(s, 4) + std::pow(c, 4)),
                  1e-13 * q.q11);
    }
}

TEST(ElasticSymmetry, QuarterTurnsSwapAxes)
{
  // About z: 1 and 2 change places, nu21/E2 = nu12/E1.
  std::ostringstream swapped;
  swapped.precision(17);
  swapped << "set Symmetry = orthotropic\n set Young moduli = 11.7e9, 144.8e9, 9e9\n set Poisson ratios = "
          << nu12 * E2 / E1 << ", 0.4, 0.3\n set Shear moduli = 9.66e9, 3e9, 6e9\n";
  expect_equal(solid<3>(nine + turned("90")).stiffness(), solid<3>(swapped.str()).stiffness());
  expect_equal(solid<2>(nine + turned("90")).stiffness(), solid<2>(swapped.str()).stiffness());
  expect_equal(solid<3>(nine + turned("90, 0, 0")).stiffness(), solid<3>(swapped.str()).stiffness());
  // Then about the new x, which is y: what stood along the new y (-x, axis 2) now stands along z.
  const auto c = solid<3>(nine + turned("90, 90, 0")).stiffness(), own = solid<3>(nine).stiffness();
  EXPECT_NEAR(c[1][1][1][1], own[0][0][0][0], 1e-13 * own.norm());
  EXPECT_NEAR(c[2][2][2][2], own[1][1][1][1], 1e-13 * own.norm());
  EXPECT_NEAR(c[0][0][0][0], own[2][2][2][2], 1e-13 * own.norm());
  EXPECT_NEAR(c[1][2][1][2], G12, 1e-13 * own.norm());
  // The last one is about axis 3 itself, which stands along x now.
  EXPECT_NEAR(
    solid<3>(nine + turned("90, 90, 90")).stiffness()[2][2][2][2], own[0][0][0][0], 1e-13 * own.norm());
}

TEST(ElasticSymmetry, TurnsKeepEigenvaluesAndTurnBack)
{
  const auto c      = test::stiffness_without_symmetry();
  const auto result = solid<3>(stiffness_text(c) + turned("20, 50, -70")).stiffness();
  EXPECT_GT((result - c).norm(), 0.1 * c.norm());
  const auto before = kelvin_eigenvalues(c), after = kelvin_eigenvalues(result);
  for (unsigned int k = 0; k < 6; ++k)
    EXPECT_NEAR(before[k], after[k], 1e-13 * before[5]);
  expect_equal(solid<3>(stiffness_text(result) + turned("70, -50, -20")).stiffness(), c);
  // The nearest isotropic solid has no direction.
  EXPECT_NEAR(solid<3>(stiffness_text(c)).isotropic().young_modulus,
              solid<3>(stiffness_text(result)).isotropic().young_modulus,
              1.);
  // Reduction to the plane and turns in it may change places.
  const auto first = solid<2>(stiffness_text(c) + turned("40")), plane = solid<2>(stiffness_text(c));
  EXPECT_NEAR(smallest_stiffness(first), smallest_stiffness(plane), 1e-13 * c.norm());
}

TEST(ElasticSymmetry, StiffnessInThreeOrders)
{
  // C_IJ = IJ for I < J; larger on the diagonal.
  std::string numbers = "set Symmetry = anisotropic\n set Stiffness = ";
  for (int row = 1; row <= 6; ++row)
    for (int column = row; column <= 6; ++column)
      numbers +=
        (row + column > 2 ? ", " : "") + std::to_string(10 * row + column + (row == column ? 200 : 0));
  numbers += "\n";
  const auto usual    = solid<3>(numbers).stiffness();
  const auto appendix = solid<3>(numbers + "set Voigt order = 11 22 33 12 13 23\n").stiffness();
  const auto body     = solid<3>(numbers + "set Voigt order = 11 22 33 12 23 13\n").stiffness();
  for (const auto &c : {usual, appendix, body})
    {
      EXPECT_EQ(c[0][0][0][0], 211.);
      EXPECT_EQ(c[1][1][2][2], 23.);
    }
  EXPECT_EQ(usual[1][2][1][2], 244.);
  EXPECT_EQ(usual[0][2][0][2], 255.);
  EXPECT_EQ(usual[0][1][0][1], 266.);
  EXPECT_EQ(usual[0][0][0][1], 16.);
  EXPECT_EQ(usual[0][1][2][0], 56.);
  EXPECT_EQ(appendix[0][1][0][1], 244.);
  EXPECT_EQ(appendix[0][2][0][2], 255.);
  EXPECT_EQ(appendix[1][2][1][2], 266.);
  EXPECT_EQ(appendix[2][2][0][2], 35.);
  EXPECT_EQ(body[0][1][0][1], 244.);
  EXPECT_EQ(body[1][2][1][2], 255.);
  EXPECT_EQ(body[0][2][0][2], 266.);
  EXPECT_EQ(body[2][2][0][2], 36.);
}

TEST(ElasticSymmetry, StiffnessOfThePlane)
{
  const std::string six = "set Symmetry = anisotropic\n set Stiffness = 11, 12, 16, 22, 26, 66\n";
  for (const std::string &assumption : {std::string(), strain_across})
    {
      const auto c = solid<2>(assumption + six);
      EXPECT_EQ(c.stiffness()[0][0][0][0], 11.);
      EXPECT_EQ(c.stiffness()[0][0][1][1], 12.);
      EXPECT_EQ(c.stiffness()[0][1][0][0], 16.);
      EXPECT_EQ(c.stiffness()[1][1][1][1], 22.);
      EXPECT_EQ(c.stiffness()[1][1][0][1], 26.);
      EXPECT_EQ(c.stiffness()[0][1][0][1], 66.);
      dealii::SymmetricTensor<2, 2> strain;
      strain[0][0] = 1.;
      strain[0][1] = 3.;
      EXPECT_EQ(c.strain_in_space(strain)[2][2], 0.);
    }
}

TEST(ElasticSymmetry, SmallestStiffness)
{
  const ElasticConstants steel{200e9, 0.3, PlaneAssumption::solid}, cork{200e9, -0.5, PlaneAssumption::solid};
  EXPECT_NEAR(smallest_stiffness(ElasticSolid<3>(steel)), 2. * steel.shear_modulus(), 1e-2);
  EXPECT_NEAR(smallest_stiffness(ElasticSolid<3>(cork)), 3. * cork.bulk_modulus(), 1e-2);
  const ElasticConstants plate{200e9, 0.3, PlaneAssumption::plane_stress};
  EXPECT_NEAR(smallest_stiffness(ElasticSolid<2>(plate)), 2. * plate.shear_modulus(), 1e-2);
  // Q12 > Q11 = Q22: stretching one way while shrinking the other sets energy free.
  EXPECT_NEAR(smallest_stiffness(solid<2>("set Symmetry = anisotropic\n set Stiffness = 3, 4, 0, 3, 0, 6\n")),
              -1.,
              1e-14);
}

TEST(ElasticSymmetry, GroupsInheritWhatTheyDoNotGive)
{
  const auto material = read(nine + turned("33.333333333333336") +
                               "subsection core\n set Orientation = -30\n end\n"
                               "subsection glue\n set Symmetry = isotropic\n set Young modulus = 3e9\n end\n"
                               "subsection ply\n set Shear moduli = 9.66e9, 6e9, 3.123456789012345e9\n end\n",
                             3);
  const auto of       = [&](const std::string &group) {
    return material.elastic_solid<3>(material.groups.at(group)).stiffness();
  };
  expect_equal(of("core"), solid<3>(nine + turned("-30")).stiffness());
  expect_equal(of("glue"), ElasticSolid<3>(ElasticConstants{3e9, 0.33, PlaneAssumption::solid}).stiffness());
  EXPECT_EQ(material.groups.at("ply").symmetry.orientation.at(0), 33.333333333333336);
  EXPECT_EQ(material.groups.at("ply").symmetry.shear_moduli.at(2), 3.123456789012345e9);
}

TEST(ElasticSymmetry, RejectsWhatIsNoSolid)
{
  const auto expect = [](const std::string &lines, const int dim, const std::vector<std::string> &words) {
    expect_input_error([&] { read(lines, dim); }, words);
  };
  const std::string orthotropic = "set Symmetry = orthotropic\n",
                    anisotropic = "set Symmetry = anisotropic\n";
  // Constants that are missing, or too many.
  expect(orthotropic, 2, {"Material/Young moduli", "nothing", "E1, E2, E3"});
  expect(orthotropic + in_plane, 3, {"Material/Young moduli", "E1, E2, E3", "plane stress alone"});
  expect(
    strain_across + orthotropic + in_plane, 2, {"Material/Young moduli", "E1, E2, E3", "plane stress alone"});
  expect("set Symmetry = cubic\n" + in_plane, 2, {"Material/Young moduli", "E [Pa]"});
  expect("set Symmetry = transversely isotropic\n set Young moduli = 2, 1\n set Poisson ratios = 0.1, 0.1\n"
         "set Shear moduli = 1, 1\n",
         3,
         {"Material/Shear moduli", "G12"});
  expect(
    nine + "subsection core\n set Poisson ratios = 0.1\n end\n", 3, {"Material/core/Poisson ratios", "nu13"});
  // What was inherited stands on no line of the section and is shown as understood.
  expect(nine + "subsection core\n set Symmetry = cubic\n end\n",
         3,
         {"Material/core/Young moduli", "1.448e+11, 1.17e+10, 9e+09"});
  expect(anisotropic, 2, {"Material/Stiffness", "nothing", "21 numbers, or the 6 of the plane"});
  expect(anisotropic + "set Stiffness = 1, 0, 0, 1, 0, 1\n", 3, {"Material/Stiffness", "21 numbers"});
  expect(nine + turned("10, 20, 30"), 2, {"Material/Orientation", "one angle"});
  expect(nine + turned("10, 20"), 3, {"Material/Orientation", "Euler"});
  // Values.
  expect("set Symmetry = cubic\n set Young moduli = -1\n set Poisson ratios = 0\n set Shear moduli = 1\n",
         3,
         {"Material/Young moduli", "> 0"});
  expect("set Symmetry = cubic\n set Young moduli = 1\n set Poisson ratios = 0\n set Shear moduli = 0\n",
         3,
         {"Material/Shear moduli", "> 0"});
  expect("set Symmetry = cubic\n set Young moduli = 1\n set Poisson ratios = 0.5\n set Shear moduli = 1\n",
         3,
         {"Material/Poisson ratios", "positive definite"});
  expect(
    anisotropic + "set Stiffness = 1, 9, 0, 1, 0, -3\n", 2, {"Material/Stiffness", "mean", "not positive"});
  std::string flat = anisotropic + "set Stiffness = 9, 0, 0, 0, 0, 0";
  for (const char *row : {", 9, 0, 0, 0, 0", ", 0, 0, 0, 0", ", 9, 0, 0", ", 9, 0", ", 9\n"})
    flat += row;
  expect(flat, 2, {"Material/Stiffness", "across the plane", "positive definite"});
  EXPECT_NO_THROW(read(flat, 3));
  // What the symmetry has no use for.
  expect(nine + "set Young modulus = 1\n", 3, {"Material/Young modulus", "orthotropic", "no use"});
  expect("set Young moduli = 1\n", 3, {"Material/Young moduli", "isotropic", "no use"});
  expect(turned("30"), 2, {"Material/Orientation", "isotropic", "no use"});
  expect(nine + "set Voigt order = 11 22 33 12 23 13\n", 3, {"Material/Voigt order", "no use"});
  expect(anisotropic + "set Stiffness = 1, 0, 0, 1, 0, 1\n set Voigt order = 11 22 33 12 23 13\n",
         2,
         {"Material/Voigt order", "21 numbers"});
  expect("subsection core\n set Symmetry = cubic\n set Poisson ratio = 0.1\n end\n",
         3,
         {"Material/core/Poisson ratio", "cubic", "no use"});
}
