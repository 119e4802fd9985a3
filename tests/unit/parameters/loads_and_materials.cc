// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/load_parameters.h>
#include <perideal/parameters/material_parameters.h>
#include <perideal/parameters/parameter_file.h>

#include "testing.h"

using namespace perideal;
using test::expect_input_error;

namespace
{
  Loads<2> read_loads(const std::string &lines)
  {
    const ParameterFile file = ParameterFile::parse(
      "subsection Boundary conditions\n subsection edge\n" + lines + " end\nend\n", "a.prm");
    dealii::ParameterHandler prm;
    LoadParameters           parameters;
    parameters.declare(prm, file);
    InputErrorCollector errors;
    file.apply(prm, errors);
    errors.raise();
    return Loads<2>(parameters);
  }

  MaterialParameters read_material(const std::string &lines)
  {
    const ParameterFile      file = ParameterFile::parse("subsection Material\n" + lines + "end\n", "a.prm");
    dealii::ParameterHandler prm;
    MaterialParameters       parameters;
    parameters.declare(prm, file);
    InputErrorCollector errors;
    file.apply(prm, errors);
    errors.raise();
    parameters.check(2);
    return parameters;
  }
} // namespace

TEST(SpaceTimeFunction, EvaluatesInSpaceAndTime)
{
  const SpaceTimeFunction<3> function("x + 2*y + 3*z + 4*t + pi", "A/B");
  EXPECT_NEAR(function.value({1., 10., 100.}, 1000.), 1 + 20 + 300 + 4000 + dealii::numbers::PI, 1e-9);
  EXPECT_FALSE(SpaceTimeFunction<2>("", "A/B").is_present());
}

TEST(SpaceTimeFunction, RejectsWrongFormulas)
{
  for (const char *formula : {"sin(x", "5*q", "x+", "z"})
    expect_input_error([&] { SpaceTimeFunction<2>(formula, "Sec/Name"); }, {"Sec/Name", formula, "x,y,t"});
}

TEST(SpaceTimeFunction, RefusesWhatMuParserTakesInSilence)
{
  const auto expect_refused = [](const std::string &formula, const std::vector<std::string> &words) {
    expect_input_error([&] { SpaceTimeFunction<2>(formula, "Sec/Name"); }, words);
  };
  // muParser takes the last number, or an assignment
  for (const char *formula : {"1,5e6", "x*(1,5)", "1e6*max(x, (y,t))", "1, 2"})
    expect_refused(formula, {"a comma stands outside the parentheses of a function", formula, "1.5e6"});
  expect_refused("2*t + 1,5", {"behind \"2*t + 1\""});
  expect_refused("x = 5", {"single ="});
  expect_refused("1; 2", {"semicolon"});
  const dealii::Point<2> point(0.25, 0.5);
  EXPECT_EQ(SpaceTimeFunction<2>("max (x, y) + min(1, (x + y)*2, pow(2, 3))", "A").value(point, 0.), 1.5);
  EXPECT_EQ(SpaceTimeFunction<2>("x <= y && y >= x && x != y ? 7 : (x == y)", "A").value(point, 0.), 7.);
}

TEST(SpaceTimeFunction, NamesWhatIsUnknownAndWhere)
{
  const auto expect_words = [](const std::string &formula, const std::vector<std::string> &words) {
    expect_input_error([&] { SpaceTimeFunction<2>(formula, "Sec/Name"); }, words);
  };
  expect_words("1e6*foo(x)", {"it has no foo", "did you mean: "});
  expect_words("1e6*sim(x)", {"it has no sim", "did you mean: sin"});
  expect_words("1e6*Pi", {"it has no Pi", "did you mean: pi"});
  expect_words("1e6*z", {"it has no z"});
  expect_words("1e6*", {"unexpected end of expression\n"});
  expect_words("1e6*(1 + )", {"position 10"});
  expect_words("sin(1, 2)", {"too many parameters for function \"sin\""});
  expect_words("2x", {"position 2"});
}

TEST(Loads, TractionAndPressure)
{
  const Loads<2> loads = read_loads("set Boundary = a, 3\n set t_x = 2*x\n set Pressure = 5*t\n");
  ASSERT_EQ(loads.conditions.size(), 1u);
  EXPECT_EQ(loads.conditions[0].boundaries, (std::vector<std::string>{"a", "3"}));
  const auto traction = Loads<2>::traction(loads.conditions[0], {3., 0.}, dealii::Point<2>(0., 1.), 2.);
  EXPECT_NEAR(traction[0], 6., 1e-14);
  EXPECT_NEAR(traction[1], -10., 1e-14);
}

TEST(Loads, RejectsContradictions)
{
  expect_input_error([] { read_loads("set u_x = 1\n"); }, {"edge/Boundary", "names no boundary"});
  expect_input_error([] { read_loads("set Boundary = a\n"); }, {"edge", "prescribes nothing"});
  expect_input_error([] { read_loads("set Boundary = a\n set u_z = 0\n"); }, {"edge/u_z", "two-dimensional"});
  expect_input_error([] { read_loads("set Boundary = a\n set u_x = 0\n set t_x = 0\n"); },
                     {"edge/t_x", "both prescribed"});
  expect_input_error([] { read_loads("set Boundary = a\n set u_x = 0\n set Pressure = 1\n"); },
                     {"edge/Pressure"});
}

TEST(Material, GroupsInheritFromTheBody)
{
  const MaterialParameters material =
    read_material("set Young modulus = 5.123456789e9\n subsection core\n set Poisson ratio = 0.1\n end\n");
  EXPECT_EQ(material.groups.at("core").young_modulus, 5.123456789e9);
  EXPECT_EQ(material.groups.at("core").poisson_ratio, 0.1);
  EXPECT_EQ(material.body.poisson_ratio, 0.33);
}

TEST(Material, RejectsUnphysicalValues)
{
  expect_input_error([] { read_material("set Poisson ratio = 0.5\n"); }, {"Material/Poisson ratio", "< 0.5"});
  expect_input_error([] { read_material("set Young modulus = 0\n"); }, {"Material/Young modulus", "> 0"});
  expect_input_error([] { read_material("set Density = -1\n"); }, {"Material/Density"});
  expect_input_error([] { read_material("subsection core\n set Young modulus = -1\n end\n"); },
                     {"Material/core/Young modulus"});
}

TEST(Material, StrengthsAreThoseOfTheCriterion)
{
  const MaterialParameters material =
    read_material("set Failure criterion = Mohr-Coulomb\n set Tensile strength = 3e6\n"
                  "set Compressive strength = 38.4e6\n"
                  "subsection platen\n set Tensile strength = 0\n end\n subsection core\n end\n");
  EXPECT_TRUE(material.has_criterion());
  EXPECT_EQ(material.groups.at("core").tensile_strength, 3e6);
  EXPECT_EQ(material.groups.at("core").compressive_strength, 38.4e6);
  EXPECT_EQ(material.groups.at("platen").tensile_strength, 0.) << "unbreakable";
  const std::string tensile = "set Failure criterion = maximum tensile stress\n";
  EXPECT_NO_THROW(read_material(tensile + "subsection core\n set Tensile strength = 1\n end\n"));
  expect_input_error([&] { read_material(tensile); }, {"Material/Failure criterion", "strength"});
  expect_input_error([&] { read_material("set Compressive strength = 1\n"); },
                     {"Material/Compressive strength", "Failure criterion"});
  expect_input_error(
    [&] {
      read_material(tensile +
                    "set Tensile strength = 1\n subsection core\n set Critical stretch = 1\n end\n");
    },
    {"Material/core/Critical stretch"});
  expect_input_error(
    [] {
      read_material("set Failure criterion = Mohr-Coulomb\n set Tensile strength = 3\n"
                    "set Compressive strength = 2\n");
    },
    {"Material/Compressive strength", ">= Tensile strength"});
}

TEST(ElasticConstants, AgreeWithHookesLaw)
{
  // Uniaxial stress must follow Young's modulus: sigma_yy = 0 at eps_yy = -nu eps_xx
  // (plane stress and 3-D), in plane strain at -nu/(1-nu).
  const double           E = 7., nu = 0.3;
  const ElasticConstants stress{E, nu, PlaneAssumption::plane_stress},
    strain{E, nu, PlaneAssumption::plane_strain}, solid{E, nu, PlaneAssumption::solid};
  EXPECT_NEAR(stress.lame_lambda() * (1 - nu) + 2 * stress.shear_modulus(), E, 1e-12);
  EXPECT_NEAR(stress.lame_lambda() * (1 - nu) - 2 * stress.shear_modulus() * nu, 0., 1e-12);
  const double lateral = -nu / (1 - nu);
  EXPECT_NEAR(strain.lame_lambda() * (1 + lateral) + 2 * strain.shear_modulus() * lateral, 0., 1e-12);
  EXPECT_NEAR(solid.lame_lambda() * (1 - 2 * nu) + 2 * solid.shear_modulus(), E, 1e-12);
  // W = kappa/2 tr^2 + mu |dev|^2 with the problem's own deviator is the same law.
  EXPECT_NEAR(stress.bulk_modulus(), stress.lame_lambda() + stress.shear_modulus(), 1e-12);
  EXPECT_NEAR(solid.bulk_modulus(), solid.lame_lambda() + 2. / 3 * solid.shear_modulus(), 1e-12);
}
