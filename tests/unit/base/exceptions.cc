// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/registry.h>

#include "testing.h"

using namespace perideal;

TEST(InputError, NamesEveryPart)
{
  const std::string message = InputError("too big")
                                .parameter("Nodes/Horizon factor")
                                .location("a.prm:7")
                                .given("99")
                                .allowed("1.01 to 20")
                                .nearest("9.9")
                                .hint("take less")
                                .what();
  for (const char *part :
       {"a.prm:7: too big", "Nodes/Horizon factor", "99", "1.01 to 20", "did you mean: 9.9", "take less"})
    EXPECT_NE(message.find(part), std::string::npos) << part << " is missing in:\n" << message;
}

TEST(InputError, LeavesOutWhatIsNotKnown)
{
  EXPECT_STREQ(InputError("wrong").nearest("").what(), "wrong");
}

TEST(Registry, FindsAndSuggests)
{
  const Registry<int> numbers("Some/Number", {{"one", 1}, {"two", 2}, {"twelve", 12}});
  EXPECT_EQ(numbers.get("two"), 2);
  test::expect_input_error([&] { numbers.get("twelv"); },
                           {"Some/Number", "one | two | twelve", "did you mean: twelve"});
}

TEST(Registry, DoesNotSuggestWhatIsFarOff)
{
  EXPECT_EQ(nearest_name("zzzzzzzz", {"one", "two"}), "");
  EXPECT_EQ(nearest_name("Onee", {"one", "two"}), "one");
}
