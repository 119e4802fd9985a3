// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_test.h"

#include <perideal/base/exceptions.h>
#include <perideal/output/files.h>

#include <gtest/gtest.h>

using namespace perideal;
using namespace output_test;

TEST(OutputDirectory, IsCreatedWithItsParentsAndLeftEmpty)
{
  const std::string directory = scratch_directory("parents") + "/one/two";
  create_output_directory(directory, MPI_COMM_WORLD);
  EXPECT_TRUE(std::filesystem::is_directory(directory));
  EXPECT_TRUE(std::filesystem::is_empty(directory));
  // The next call writes for a moment: not while a rank still looks.
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_NO_THROW(create_output_directory(directory, MPI_COMM_WORLD));
}

// Root may write everywhere, but nobody below a file.
TEST(OutputDirectory, NamesTheParameterWhenItCannotBeWritten)
{
  for (const std::string directory : {"/dev/null/below", ""})
    try
      {
        create_output_directory(directory, MPI_COMM_WORLD);
        ADD_FAILURE() << "no error for '" << directory << "'";
      }
    catch (const InputError &error)
      {
        EXPECT_EQ(error.parameter(), "Output directory");
        EXPECT_TRUE(error.has_given() || directory.empty());
      }
}

TEST(ReplaceFile, LeavesTheNewTextAndNothingElse)
{
  const std::string directory = scratch_directory("replace");
  create_output_directory(directory, MPI_COMM_WORLD);
  if (is_first_rank())
    {
      replace_file(directory + "/file", "a longer old text");
      replace_file(directory + "/file", "new");
    }
  EXPECT_EQ(read_text(directory + "/file"), "new");
  const std::filesystem::directory_iterator files(directory);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(ReplaceFile, FailsWhereItCannotWrite)
{
  EXPECT_THROW(replace_file("/dev/null/file", "text"), ComputationError);
}

TEST(Csv, QuotesNamesAndKeepsAllDigits)
{
  std::ostringstream out;
  write_csv_header(out, {"time [s]", "left, top", "a \"b\""});
  write_csv_row(out, {0.1, 1. / 3., 2});
  EXPECT_EQ(out.str(),
            "time [s],\"left, top\",\"a \"\"b\"\"\"\n"
            "0.10000000000000001,0.33333333333333331,2\n");
}
