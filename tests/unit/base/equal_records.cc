// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/equal_records.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;

namespace
{
  std::vector<EqualRecords::Entry> record_of(const std::vector<double> &values,
                                             const double               tolerance = 1e-12)
  {
    std::vector<EqualRecords::Entry> result;
    for (const double value : values)
      result.push_back({value, tolerance});
    return result;
  }
} // namespace

TEST(EqualRecords, RecordsThatDifferByRoundingHaveOnePlace)
{
  EqualRecords equal(true);
  equal.place_of(record_of({1., 0., -2.})) = 7;
  EXPECT_EQ(equal.place_of(record_of({1. + 5e-13, -5e-13, -2.})), 7u);
  EXPECT_EQ(equal.place_of(record_of({1. + 2e-12, 0., -2.})), EqualRecords::none);
  EXPECT_EQ(equal.place_of(record_of({1., 0.})), EqualRecords::none);
  // Back to the first, past the last one seen.
  EXPECT_EQ(equal.place_of(record_of({1., 0., -2.})), 7u);
}

TEST(EqualRecords, PlacesStayUnsetUntilTheCallerSetsThem)
{
  EqualRecords equal(true);
  EXPECT_EQ(equal.place_of(record_of({3.})), EqualRecords::none);
  EXPECT_EQ(equal.place_of(record_of({3.})), EqualRecords::none);
  equal.place_of(record_of({3.})) = 1;
  EXPECT_EQ(equal.place_of(record_of({3.})), 1u);
}

TEST(EqualRecords, GivesUpWhereHardlyAnyAreEqual)
{
  EqualRecords rare(true), many(true);
  EXPECT_FALSE(EqualRecords(false).is_looking());
  for (unsigned int k = 0; k < 1000 && rare.is_looking(); ++k)
    rare.place_of(record_of({std::sqrt(k)}));
  EXPECT_FALSE(rare.is_looking());
  for (unsigned int k = 0; k < 1000; ++k)
    many.place_of(record_of({std::sqrt(k % 100)}));
  EXPECT_TRUE(many.is_looking());
}

TEST(EqualRecords, NumbersAreToldApart)
{
  EqualRecords equal(true);
  for (std::size_t n = 0; n < 1000; ++n)
    {
      const std::vector<EqualRecords::Entry> record = {EqualRecords::exactly(n),
                                                       EqualRecords::exactly(1000000000 - n)};
      EXPECT_EQ(equal.place_of(record), EqualRecords::none);
      equal.place_of(record) = n;
      EXPECT_EQ(equal.place_of(record), n);
    }
  EXPECT_TRUE(equal.is_looking());
}
