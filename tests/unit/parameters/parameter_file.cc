// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/parameter_file.h>

#include "testing.h"

using namespace perideal;
using test::expect_input_error;

namespace
{
  const std::string scene = "# a comment\n"
                            "set Length = 2   # of the bar\n"
                            "subsection Bar\n"
                            "  set Kind = steel\n"
                            "  subsection left end\n"
                            "    set Held = true\n"
                            "  end\n"
                            "end\n";

  /// The values that declare() binds.
  struct Values
  {
    double      length = 1;
    std::string kind   = "wood";
    bool        held   = false;

    void declare(dealii::ParameterHandler &prm)
    {
      prm.add_parameter("Length", length, "", dealii::Patterns::Double(0, 10));
      prm.enter_subsection("Bar");
      prm.add_parameter("Kind", kind, "", dealii::Patterns::Selection("wood|steel|stone"));
      prm.enter_subsection("left end");
      prm.add_parameter("Held", held);
      prm.leave_subsection();
      prm.leave_subsection();
    }
  };

  Values read(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    ParameterFile file = ParameterFile::parse(text, "bar.prm");
    for (const std::string &override : overrides)
      file.override_with(override);
    dealii::ParameterHandler prm;
    Values                   values;
    values.declare(prm);
    InputErrorCollector errors;
    file.apply(prm, errors);
    errors.raise();
    return values;
  }
} // namespace

TEST(ParameterFile, ReadsSectionsAndComments)
{
  const Values values = read(scene);
  EXPECT_EQ(values.length, 2.);
  EXPECT_EQ(values.kind, "steel");
  EXPECT_TRUE(values.held);
  EXPECT_EQ(ParameterFile::parse(scene, "").subsections("Bar"), std::vector<std::string>{"left end"});
}

TEST(ParameterFile, LaterOverridesWin)
{
  const Values values = read(scene, {"Length=3", "Bar/Kind = stone", "Length=4"});
  EXPECT_EQ(values.length, 4.);
  EXPECT_EQ(values.kind, "stone");
}

TEST(ParameterFile, ContinuesLines)
{
  EXPECT_EQ(ParameterFile::parse("set A = 1, \\\n  2\n", "").value_of("A", ""), "1, 2");
}

TEST(ParameterFile, MessagesNameFileLineAndChoices)
{
  expect_input_error([] { read("set Lenght = 1\n"); }, {"bar.prm:1", "Lenght", "did you mean: Length"});
  expect_input_error([] { read("\nsubsection Barr\nset Kind = wood\nend\n"); },
                     {"bar.prm:3", "Barr", "did you mean: Bar"});
  expect_input_error([] { read("subsection Bar\n  set Kind = stele\nend\n"); },
                     {"bar.prm:2", "Bar/Kind", "stele", "wood | steel | stone", "did you mean: steel"});
  expect_input_error([] { read("set Length = 11\n"); }, {"bar.prm:1", "Length", "11", "0", "10"});
  expect_input_error([] { read("set Length = long\n"); }, {"bar.prm:1", "Length", "long"});
  // Far from any name.
  expect_input_error([] { read("set Zzzzzzzzzzzzzz = 1\nsubsection Qqqqqqqqqqqqq\nset X = 1\nend\n"); },
                     {"2 mistakes", "bar.prm:1", "Zzzzzzzzzzzzzz", "bar.prm:3", "Qqqqqqqqqqqqq"});
  expect_input_error([] { read(scene, {"Bar/Knd=wood"}); }, {"--set", "Knd", "Kind"});
}

TEST(ParameterFile, RejectsBrokenText)
{
  expect_input_error([] { read("subsection Bar\nset Kind = wood\n"); }, {"bar.prm:1", "never closed"});
  expect_input_error([] { read("end\n"); }, {"bar.prm:1", "without a subsection"});
  expect_input_error([] { read("set Length\n"); }, {"bar.prm:1", "no \"=\""});
  expect_input_error([] { read("Length = 1\n"); }, {"bar.prm:1", "not understood"});
  expect_input_error([] { read(scene, {"Length"}); }, {"--set"});
  expect_input_error([] { ParameterFile::read("/no/such/file.prm"); }, {"/no/such/file.prm", "cannot read"});
}

TEST(ParameterFile, LocatesErrorsFoundLater)
{
  const ParameterFile file  = ParameterFile::parse(scene, "bar.prm");
  const std::string   first = file.locate(InputError("bad").parameter("Bar/Kind")).what();
  EXPECT_NE(first.find("bar.prm:4"), std::string::npos) << first;
  EXPECT_NE(first.find("steel"), std::string::npos) << first;
}
