// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/reference.h>

#include "testing.h"

#include <set>

using namespace perideal;

namespace
{
  std::string allowed(const std::string &pattern, const std::string &meaning)
  {
    return reference_entry(pattern, "", meaning).allowed;
  }
} // namespace

/// Bounds come from the pattern, or from the meaning where that tells more; those that bound nothing are not
/// told.
TEST(Reference, TellsRangesInWords)
{
  const std::string any = "[Double -MAX_DOUBLE...MAX_DOUBLE (inclusive)]";
  EXPECT_EQ(allowed(any, "A number [m]"), "number");
  EXPECT_EQ(allowed(any, "When it ends, > 0 [s]"), "number > 0");
  EXPECT_EQ(allowed(any, "Energy >= 0 [J/m^2]; 0: none"), "number, at least 0");
  EXPECT_EQ(allowed(any, "Elongation [m], > 0; 0: to the end"), "number > 0, or 0");
  EXPECT_EQ(allowed(any, "Part, 0 < safety <= 1 [-]"), "number > 0 and at most 1");
  EXPECT_EQ(allowed(any, "Ratio, -1 < nu < 0.5 [-]"), "number > -1 and < 0.5");
  EXPECT_EQ(allowed(any, "In spacings of its cell, 1.5 to 6 [-]"), "number, 1.5 to 6");
  EXPECT_EQ(allowed("[Double 0...MAX_DOUBLE (inclusive)]", "Radius [m]"), "number, at least 0");
  EXPECT_EQ(allowed("[Double 0...0.5 (inclusive)]", "Share [-]"), "number, 0 to 0.5");
  EXPECT_EQ(allowed("[Integer range 1...2147483647 (inclusive)]", "Count"), "whole number, at least 1");
  EXPECT_EQ(allowed("[Integer range -1...4 (inclusive)]", "Count"), "whole number, -1 to 4");
}

/// Lists tell how many entries they have where that is bounded.
TEST(Reference, TellsListsWithoutLengths)
{
  const std::string number = "<[Double -MAX_DOUBLE...MAX_DOUBLE (inclusive)]>";
  EXPECT_EQ(allowed("[List of " + number + " of length 0...4294967295 (inclusive)]", "Moduli > 0 [Pa]"),
            "numbers > 0; separated by commas");
  EXPECT_EQ(allowed("[List of " + number + " of length 0...3 (inclusive)]", "Corner [m]"),
            "up to 3 numbers; separated by commas");
  EXPECT_EQ(allowed("[List of <[Anything]> of length 0...4294967295 (inclusive)]", "Boundaries"),
            "names; separated by commas");
  EXPECT_EQ(allowed("[List of <[Integer range 1...9 (inclusive)]> of length 0...3 (inclusive)]", "Cells"),
            "up to 3 whole numbers, 1 to 9; separated by commas");
}

TEST(Reference, TellsUnitsDefaultsAndChoices)
{
  const ReferenceEntry given = reference_entry(
    "[Double 0...MAX_DOUBLE (inclusive)]", "7e10", "Modulus > 0 [Pa]; the scene must give it");
  EXPECT_TRUE(given.must_be_given);
  EXPECT_EQ(given.unit, "Pa");
  EXPECT_EQ(given.default_in_words, "none");
  EXPECT_EQ(given.default_value, "");

  const ReferenceEntry formula =
    reference_entry("[Anything]", "", "Displacement [m], a formula in x, y, z, t; empty: free");
  EXPECT_EQ(formula.allowed, "formula in x, y, z, t");
  EXPECT_EQ(formula.default_in_words, "free");

  const ReferenceEntry choice = reference_entry("[Selection a|b c ]", "b c", "What it is, over [m]");
  EXPECT_EQ(choice.unit, "-");
  EXPECT_EQ(choice.choices, (std::vector<std::string>{"a", "b c"}));
  EXPECT_EQ(choice.allowed, "a | b c");

  EXPECT_EQ(reference_entry("[Double 0...MAX_DOUBLE (inclusive)]", "1.797e308", "Until [s]").default_in_words,
            "none");
  EXPECT_EQ(
    reference_entry("[Double 0...1 (inclusive)]", "1.0000000000e-08", "Tolerance [-]").default_in_words,
    "1e-08");
}

/// The fifteen are parameters, and no parameter stands twice.
TEST(Reference, HasEveryParameterOnce)
{
  std::set<std::string> paths;
  for (const ReferenceEntry &entry : reference())
    EXPECT_TRUE(paths.insert(entry.path()).second) << entry.path();
  EXPECT_EQ(first_parameters().size(), 15U);
  for (const std::string &path : first_parameters())
    EXPECT_EQ(paths.count(path), 1U) << path;
}
