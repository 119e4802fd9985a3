// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <iostream>
#include <sstream>
#include <string>

namespace
{
  /// What ranks other than the first print: failures only, with their rank.
  class FailurePrinter : public testing::EmptyTestEventListener
  {
  public:
    explicit FailurePrinter(const unsigned int rank)
      : rank(rank)
    {
    }

    void OnTestStart(const testing::TestInfo &test) override
    {
      test_name = std::string(test.test_suite_name()) + "." + test.name();
    }

    void OnTestPartResult(const testing::TestPartResult &result) override
    {
      // GoogleTest holds its lock here: asking it for the current test would wait for ever.
      if (!result.failed())
        return;
      std::ostringstream text;
      text << (result.file_name() ? result.file_name() : "unknown file") << ":" << result.line_number()
           << ": failure on rank " << rank << " in " << test_name << "\n"
           << result.message() << "\n";
      std::cerr << text.str() << std::flush;
    }

  private:
    const unsigned int rank;
    std::string        test_name;
  };
} // namespace

int main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  testing::InitGoogleTest(&argc, argv);

  const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  if (rank > 0)
    {
      auto &listeners = testing::UnitTest::GetInstance()->listeners();
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(new FailurePrinter(rank)); // GoogleTest deletes it
    }

  // A test that fails on any rank fails the program on all.
  const int failed = RUN_ALL_TESTS();
  return dealii::Utilities::MPI::max(failed, MPI_COMM_WORLD);
}
