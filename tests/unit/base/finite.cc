// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/finite.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

using namespace perideal;

namespace
{
  constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
  constexpr double infinity  = std::numeric_limits<double>::infinity();
} // namespace

TEST(Finite, OneBadNumberSpoilsARange)
{
  EXPECT_TRUE(is_finite(std::vector<double>{1., -1e308, 0.}));
  EXPECT_FALSE(is_finite(std::vector<double>{1., no_number}));
  EXPECT_FALSE(is_finite(std::vector<double>{-infinity, 1.}));
  EXPECT_TRUE(is_finite(std::vector<double>()));
}

TEST(Finite, RequiredNumbersPassOrAreNamed)
{
  EXPECT_EQ(require_finite(-3., "the residual"), -3.);
  for (const auto &[value, says] : {std::pair(no_number, "the residual is not a number"),
                                    std::pair(infinity, "the residual is infinite")})
    try
      {
        require_finite(value, "the residual");
        ADD_FAILURE() << "nothing was thrown";
      }
    catch (const ComputationError &error)
      {
        EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
      }
}

TEST(Finite, TreesNameTheirBadNumbers)
{
  const nlohmann::ordered_json tree = {
    {"energy", {{"strain", no_number}, {"external", 1.}}}, {"list", {1, nullptr, infinity}}, {"text", "nan"}};
  EXPECT_EQ(non_finite_paths(tree), (std::vector<std::string>{"/energy/strain", "/list/2"}));
  EXPECT_TRUE(non_finite_paths({{"energy", 1.}, {"none", nullptr}}).empty());
}
