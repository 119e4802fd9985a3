// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/hdf5.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>

using namespace perideal;

namespace
{
  unsigned int rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  std::string scratch_file(const std::string &name)
  {
    std::filesystem::create_directories("scratch_base");
    return "scratch_base/" + name + "_" +
           std::to_string(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)) + ".h5";
  }

  template <typename Error, typename Function>
  std::string message_of(const Function &function)
  {
    try
      {
        function();
      }
    catch (const Error &error)
      {
        return error.what();
      }
    return "nothing was thrown";
  }

  void expect_says(const std::string &message, const std::vector<std::string> &words)
  {
    for (const std::string &word : words)
      EXPECT_NE(message.find(word), std::string::npos) << message << "\n does not say: " << word;
  }
} // namespace

TEST(Hdf5, TablesOfAllRanksRoundTrip)
{
  const std::string         path    = scratch_file("round_trip");
  const unsigned int        n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const std::vector<double> own     = {rank() + 0.1, rank() + 0.2};
  {
    hdf5::Writer file(path, MPI_COMM_WORLD);
    file.write("group/numbers", own, {1, 2});
    const std::vector<std::uint64_t> of_last = {1, ~std::uint64_t(0)};
    const bool                       is_last = rank() + 1 == n_ranks;
    file.write("of the last rank", is_last ? of_last : std::vector<std::uint64_t>(), {is_last ? 2u : 0u});
    file.write("no lines", std::vector<double>(), {0, 3});
    file.write("no columns", std::vector<double>(), {5, 0});
    file.close();
  }
  const hdf5::Reader file(path);
  EXPECT_EQ(file.read<double>("group/numbers", rank(), 1), own);
  EXPECT_EQ(file.read<std::uint64_t>("of the last rank"), (std::vector<std::uint64_t>{1, ~std::uint64_t(0)}));
  EXPECT_EQ(file.shape("no lines"), (std::vector<std::uint64_t>{0, 3}));
  EXPECT_EQ(file.shape("no columns"), (std::vector<std::uint64_t>{5 * n_ranks, 0}));
  EXPECT_TRUE(file.read<double>("no lines").empty());
  EXPECT_TRUE(file.read<double>("no columns").empty());
}

TEST(Hdf5, WhatCannotBeReadIsNamedAndNothingIsPrinted)
{
  const std::string path = scratch_file("unreadable");
  {
    hdf5::Writer              file(path, MPI_COMM_WORLD);
    const std::vector<double> numbers(rank() == 0 ? 2 : 0);
    file.write("numbers", numbers, {numbers.size()});
    file.close();
  }
  testing::internal::CaptureStderr();
  using hdf5::Unreadable;
  expect_says(message_of<Unreadable>([&] { hdf5::Reader(path + ".not"); }), {path + ".not", "No such file"});
  const hdf5::Reader file(path);
  expect_says(message_of<Unreadable>([&] { file.read<double>("absent"); }), {path, "'absent'"});
  expect_says(message_of<Unreadable>([&] { file.read<double>("numbers", 1, 2); }), {path, "'numbers'"});
  expect_says(message_of<Unreadable>([&] { file.read<std::uint64_t>("numbers"); }), {path, "'numbers'"});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Hdf5, AFileThatCannotBeMadeIsAComputationErrorOnAllRanks)
{
  testing::internal::CaptureStderr();
  expect_says(message_of<ComputationError>([] { hdf5::Writer("/dev/null/below.h5", MPI_COMM_WORLD); }),
              {"cannot write '/dev/null/below.h5'"});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Hdf5, AFullDiskIsAComputationErrorOnAllRanks)
{
  testing::internal::CaptureStderr();
  // Few numbers wait for the end of the file, many do not.
  for (const unsigned int n : {3u, 300000u})
    {
      const std::string message = message_of<ComputationError>([&] {
        hdf5::Writer file("/dev/full", MPI_COMM_WORLD);
        file.write("numbers", std::vector<double>(n, rank()), {n});
        file.close();
      });
      expect_says(message, {"cannot write '/dev/full'", "No space left on device"});
    }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Hdf5, AnErrorUnwindsPastAnOpenFileInSilence)
{
  testing::internal::CaptureStderr();
  EXPECT_THROW(
    {
      hdf5::Writer file(scratch_file("unwinding"), MPI_COMM_WORLD);
      throw ComputationError("the motion is not finite");
    },
    ComputationError);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}
