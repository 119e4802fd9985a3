// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/compare.h>
#include <perideal/application/sweep.h>

#include "testing.h"

using namespace perideal;
using namespace perideal::test;

namespace
{
  using Json = nlohmann::ordered_json;

  Json summary_of(const unsigned int nodes, const double error)
  {
    return {{"status", "done"},
            {"mesh", {{"dim", 2}}},
            {"nodes", nodes},
            {"energy", {{"strain", 2.5}}},
            {"errors", {{"exact", {{"l2", error}}}}},
            {"seconds", {{"total", 1.25}}}};
  }
} // namespace

TEST(Sweep, ReadsValuesWithCommasAndWithout)
{
  EXPECT_EQ(read_swept_parameter("Mesh/Refinements=0, 1,2").values,
            (std::vector<std::string>{"0", "1", "2"}));
  const SweptParameter cells = read_swept_parameter(" Mesh/Cells = 10, 20; 20, 40");
  EXPECT_EQ(cells.path, "Mesh/Cells");
  EXPECT_EQ(cells.values, (std::vector<std::string>{"10, 20", "20, 40"}));
  for (const char *text : {"Mesh/Refinements", "=1", "Mesh/Refinements="})
    expect_input_error([&] { read_swept_parameter(text); }, {"--sweep needs", "value, value"});
}

TEST(Sweep, OrderIsThatOfTheSizeOfCells)
{
  const std::vector<SweptParameter> parameters = {{"Mesh/Refinements", {"0", "1"}},
                                                  {"Material/Form", {"a", "b"}}};
  const auto                        table      = sweep_table(parameters,
                                 {{{"0", "a"}, summary_of(100, 0.04)},
                                                              {{"1", "a"}, summary_of(400, 0.01)},
                                                              {{"1", "b"}, summary_of(400, 0.005)},
                                                              {{"0", "b"}, Json::object()}});
  const std::vector<std::string>    header     = {"Mesh/Refinements",
                                                  "Material/Form",
                                                  "status",
                                                  "nodes",
                                                  "strain energy [J]",
                                                  "error against exact [-]",
                                                  "order against exact [-]",
                                                  "seconds"};
  EXPECT_EQ(table[0], header);
  EXPECT_EQ(table[1][6], "") << "nothing before it";
  EXPECT_EQ(table[2][6], "2") << "half the size, a quarter of the error";
  EXPECT_EQ(table[3][6], "") << "as many nodes";
  EXPECT_EQ(table[4], (std::vector<std::string>{"0", "b", "failed", "", "", "", "", ""}));
}

TEST(Compare, ShowsDifferencesAndParametersThatDiffer)
{
  Json one = summary_of(100, 0.04), other = summary_of(400, 0.01);
  one["parameters"]      = {{"Mesh", {{"Refinements", "0"}, {"Scale", "1"}}}};
  other["parameters"]    = {{"Mesh", {{"Refinements", "1"}, {"Scale", "1"}}}};
  other["ranks"]         = 2;
  const std::string text = compare_summaries(one, other);
  for (const char *words :
       {"nodes", "100", "400", "+300 %", "errors exact l2", "-75 %", "ranks", "Mesh/Refinements"})
    EXPECT_NE(text.find(words), std::string::npos) << words;
  EXPECT_EQ(text.find("Mesh/Scale"), std::string::npos);
  EXPECT_NE(compare_summaries(one, one).find("all parameters are equal"), std::string::npos);
}
