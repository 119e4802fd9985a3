// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/load_parameters.h>
#include <perideal/parameters/space_time_function.h>
#include <perideal/parameters/tables.h>

#include "testing.h"

#include <cmath>
#include <sstream>

using namespace perideal;
using test::expect_input_error;

namespace
{
  Table parse(const std::string &text, const OutsideTable outside = OutsideTable::error)
  {
    return Table::parse(text, "load.csv", outside);
  }

  /// Up to 2 at t = 1, down to -1 at t = 3.
  const Tables tables = {{"ramp", parse("time,value\n0,0\n1,2\n3,-1\n")},
                         {"turn", parse("time,value\n-5,-10\n5,10\n")},
                         {"held", parse("time,value\n0,3\n1,4\n", OutsideTable::hold)}};

  double ramp(const double t)
  {
    return t < 1. ? 2. * t : 2. - 1.5 * (t - 1.);
  }
} // namespace

TEST(Tables, AgreeWithTheFormulaOfTheSameLines)
{
  const SpaceTimeFunction<2> by_table("1e-3*x*ramp(t)^2 - sin(y)*ramp( t/2+0.5 )", "A", tables);
  const SpaceTimeFunction<2> by_formula(
    "1e-3*x*(t<1?2*t:2-1.5*(t-1))^2 - sin(y)*(t/2+0.5<1?t+1:2-1.5*(t/2-0.5))", "A");
  const dealii::Point<2> point(1.7, 0.4);
  EXPECT_TRUE(by_table.depends_on_time());
  for (int n = 0; n <= 300; ++n)
    EXPECT_NEAR(by_table.value(point, 0.01 * n), by_formula.value(point, 0.01 * n), 1e-12) << n;
  // Back in time, and again.
  EXPECT_NEAR(by_table.value(point, 0.25), by_formula.value(point, 0.25), 1e-12);
  EXPECT_NEAR(by_table.value(point, 0.25), by_formula.value(point, 0.25), 1e-12);
}

TEST(Tables, MayStandInEachOther)
{
  const SpaceTimeFunction<3> function("ramp(turn(t)) + max(held(2), z)", "A", tables);
  EXPECT_NEAR(function.value({0., 0., 9.}, 0.3), ramp(0.6) + 9., 1e-12);
  EXPECT_NEAR(function.value({0., 0., 1.}, 1.2), ramp(2.4) + 4., 1e-12);
}

TEST(Tables, CopiesOfAFunctionHaveTheirTimes)
{
  const SpaceTimeFunction<2> function("ramp(t)", "A", tables), copy = function;
  EXPECT_EQ(function.value({}, 0.5), 1.);
  EXPECT_EQ(copy.value({}, 1.), 2.);
  EXPECT_EQ(function.value({}, 0.5), 1.);
}

TEST(Tables, ReadColumnsByName)
{
  const Table table =
    parse("\xEF\xBB\xBF# measured\r\n force , value, time\r\n\r\n7, 1.5, 0\r\n8, 2.5, 4\r\n");
  EXPECT_NEAR(table.value(1.), 1.75, 1e-15);
  EXPECT_EQ(table.value(-3.), 1.5);
  EXPECT_EQ(table.value(4.), 2.5);
  EXPECT_EQ(table.range(), "from 0 s to 4 s");
}

TEST(Tables, RefuseWhatIsNoTable)
{
  const auto expect_words = [](const std::string &text, const std::vector<std::string> &words) {
    expect_input_error([&] { parse(text); }, words);
  };
  expect_words("time,value\n0,1\n2,1\n1,1\n", {"load.csv:4", "do not increase", "1"});
  expect_words("time,value\n0,1\n0,2\n", {"load.csv:3", "do not increase"});
  expect_words("t,value\n0,1\n1,1\n", {"load.csv:1", "no column \"time\"", "t,value"});
  expect_words("time,force\n0,1\n1,1\n", {"no column \"value\""});
  expect_words("time,value\n0,1\n1\n", {"load.csv:3", "too few values"});
  expect_words("time,value\n0,one\n1,1\n", {"load.csv:2", "not a number", "one"});
  expect_words("time,value\n0,nan\n1,1\n", {"load.csv:2", "not a finite number", "nan"});
  expect_words("time,value\n0,1\n", {"load.csv", "less than two times"});
  expect_words("", {"load.csv", "less than two times"});
}

TEST(Tables, AreAskedWithinTheirTimes)
{
  const SpaceTimeFunction<2> function("2*ramp(t)", "Body force/b_x", tables);
  function.check_tables(0.);
  function.check_tables(3. + 1e-12);
  expect_input_error([&] { function.check_tables(3.5); },
                     {"Body force/b_x", "the table ramp", "3.5", "from 0 s to 3 s", "Outside = hold"});
  SpaceTimeFunction<2>("held(t)", "A", tables).check_tables(100.);
}

namespace
{
  /// f at points of a plane that lie nowhere in particular.
  template <typename Function>
  std::string scattered(const Function &f)
  {
    std::ostringstream text;
    text.precision(16);
    text << "value, y, x\n";
    for (int k = 0; k < 60; ++k)
      {
        // Halton's points
        const double x = 2. * std::fmod(k * 0.5698402909980532, 1.),
                     y = std::fmod(k * 0.7548776662466927, 1.);
        text << f(x, y) << ", " << y << ", " << x << '\n';
      }
    return text.str();
  }
} // namespace

TEST(Fields, AreExactForLinearFunctions)
{
  const auto                 f     = [](const double x, const double y) { return 3. + 2. * x - 5. * y; };
  const Tables               table = {{"heat", parse(scattered(f))}, {"ramp", tables.at("ramp")}};
  const SpaceTimeFunction<2> plane("20 + heat*ramp(t) + t*x", "A", table);
  const SpaceTimeFunction<3> space("heat", "A", table);
  EXPECT_TRUE(plane.depends_on_time());
  EXPECT_FALSE(space.depends_on_time());
  for (const double x : {0.1, 0.7, 1.3, 1.9})
    for (const double y : {0.05, 0.5, 0.9})
      {
        for (const double t : {0.3, 0.8, 0.3})
          EXPECT_NEAR(plane.value({x, y}, t), 20. + f(x, y) * ramp(t) + t * x, 1e-11);
        EXPECT_NEAR(space.value({x, y, 7.}, 0.), f(x, y), 1e-11) << "no z: the same at all heights";
      }
}

TEST(Fields, TakeTheValuesOfTheirPointsAndComeNearBetween)
{
  const auto f    = [](const double x, const double y) { return std::sin(2. * x) * std::cos(y); };
  const auto heat = parse("x,y,value\n0,0,5\n1,0,6\n0,1,7\n1,1,9\n.5,.5,-3\n").field();
  EXPECT_EQ(heat->value({0.5, 0.5, 0.}), -3.);
  EXPECT_NEAR(heat->value({0.5 + 1e-9, 0.5, 0.}), -3., 1e-6);
  EXPECT_EQ(heat->value({1., 1., 0.}), 9.);
  const auto fine = parse(scattered(f)).field();
  EXPECT_NEAR(fine->value({0.9, 0.45, 0.}), f(0.9, 0.45), 0.05);
  // Of one axis, and of points on a line, along which alone anything is known.
  EXPECT_NEAR(parse("z,value\n0,1\n2,5\n3,7\n").field()->value({8., 9., 2.5}), 6., 1e-12);
  EXPECT_NEAR(parse("x,y,value\n0,0,1\n1,1,3\n2,2,5\n").field()->value({1.5, 1.5, 0.}), 4., 1e-12);
}

TEST(Fields, EndAtTheirPoints)
{
  const std::string          text  = "x,y,value\n0,0,5\n1,0,6\n0,1,7\n1,1,8\n";
  const Tables               table = {{"heat", parse(text)}, {"held", parse(text, OutsideTable::hold)}};
  const SpaceTimeFunction<2> heat("2*heat", "Thermal strain/Temperature", table);
  EXPECT_NEAR(heat.value({-0.1, 1.1}, 0.), 2. * 7.1, 1e-11);
  EXPECT_FALSE(heat.is_finite({1000., 500.}, 0.));
  expect_input_error(
    [&] {
      heat.value({1000., 500.}, 0.);
    },
    {"Thermal strain/Temperature",
     "the field heat has no point near (1000 500) m",
     "x from 0 to 1 m, y from 0 to 1 m",
     "Tables/heat/Outside = hold"});
  EXPECT_EQ(SpaceTimeFunction<2>("held", "A", table).value({1000., 500.}, 0.), 8.);
}

TEST(Fields, RefuseWhatIsNoField)
{
  const auto expect_words = [](const std::string &text, const std::vector<std::string> &words) {
    expect_input_error([&] { parse(text); }, words);
  };
  expect_words("x,y\n0,0\n1,0\n", {"load.csv:1", "no column \"value\"", "x,y"});
  expect_words("x,value\n0,1\n", {"load.csv", "less than two points"});
  expect_words("x,value\n0,1\n1\n", {"load.csv:3", "too few values"});
  const Tables table = {{"heat", parse("x,value\n0,1\n1,1\n")},
                        {"cold", parse("x,value\n0,1\n1,1\n")},
                        {"ramp", tables.at("ramp")}};
  expect_input_error([&] { SpaceTimeFunction<2>("heat - cold", "Sec/Name", table); },
                     {"Sec/Name", "two fields stand in it, heat and cold", "one field"});
  expect_input_error([&] { SpaceTimeFunction<2>("ramp(heat)", "Sec/Name", table); },
                     {"the table ramp is a function of time"});
}

TEST(Tables, StandInFormulasWithATime)
{
  const auto expect_words = [](const std::string &formula, const std::vector<std::string> &words) {
    expect_input_error([&] { SpaceTimeFunction<2>(formula, "Sec/Name", tables); }, words);
  };
  expect_words("2*ramp", {"Sec/Name", "the table ramp", "without a time", "ramp(t)"});
  expect_words("ramp()", {"without a time"});
  expect_words("ramp(x)", {"the table ramp is a function of time"});
  expect_words("ramp(t", {"parenthesis"});
  expect_words("ramq(t)", {"it has no ramq", "did you mean: ramp"});
}
