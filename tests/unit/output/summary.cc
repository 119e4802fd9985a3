// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_test.h"

#include <perideal/base/exceptions.h>
#include <perideal/output/files.h>
#include <perideal/output/summary.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

using namespace perideal;
using namespace output_test;

TEST(Summary, RoundTripKeepsOrderAndDigits)
{
  const auto directory = scratch_directory("summary");
  create_output_directory(directory, MPI_COMM_WORLD);

  nlohmann::ordered_json summary;
  summary["status"]       = "done";
  summary["nodes"]        = std::uint64_t(5000000000);
  summary["errors"]["l2"] = 1. / 3e4;
  summary["bad"]     = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};
  summary["command"] = "caf\xe9"; // Latin-1, no UTF-8
  write_summary(directory + "/summary.json", summary, MPI_COMM_WORLD);

  const auto read = nlohmann::ordered_json::parse(read_text(directory + "/summary.json"));
  EXPECT_EQ(read.begin().key(), "status");
  EXPECT_EQ(read["status"], "done");
  EXPECT_EQ(read["nodes"], 5000000000u);
  EXPECT_EQ(read["errors"]["l2"].get<double>(), 1. / 3e4);
  EXPECT_TRUE(read["bad"][0].is_null());
  EXPECT_TRUE(read["bad"][1].is_null());
  EXPECT_EQ(read["command"], "caf\xef\xbf\xbd");
}

TEST(Summary, RunsThatAreDoneHaveFiniteNumbers)
{
  const auto directory = scratch_directory("summary_not_finite");
  create_output_directory(directory, MPI_COMM_WORLD);
  const nlohmann::ordered_json summary = {
    {"status", "done"},
    {"energy", {{"strain", std::numeric_limits<double>::infinity()}, {"drift", nullptr}}}};
  try
    {
      write_summary(directory + "/summary.json", summary, MPI_COMM_WORLD, true);
      ADD_FAILURE() << "nothing was thrown";
    }
  catch (const ComputationError &error)
    {
      EXPECT_NE(std::string(error.what()).find("/energy/strain"), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find("drift"), std::string::npos) << error.what();
    }
  const auto read = nlohmann::ordered_json::parse(read_text(directory + "/summary.json"));
  EXPECT_EQ(read["status"], "failed");
  EXPECT_TRUE(read["energy"]["strain"].is_null());
}

TEST(ReportTable, AlignsNamesLeftAndNumbersRight)
{
  EXPECT_EQ(report_table({"phase", "s"}, {{"mesh", "0.5"}, {"neighbours", "12"}}),
            "phase         s\n"
            "mesh        0.5\n"
            "neighbours   12\n");
}

TEST(ShortNumber, HasFourDigitsOrADash)
{
  EXPECT_EQ(short_number(3.14159e-4), "0.0003142");
  EXPECT_EQ(short_number(1.23456e9), "1.235e+09");
  EXPECT_EQ(short_number(std::numeric_limits<double>::quiet_NaN()), "-");
}

TEST(PeakMemory, AddsUpTheRanksAndRemembersThePeak)
{
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const auto         before  = peak_memory_bytes(MPI_COMM_WORLD);
  // deal.II's libraries alone take some tens of megabytes.
  EXPECT_GT(before, n_ranks * (std::uint64_t(10) << 20));

  constexpr std::uint64_t size = std::uint64_t(400) << 20;
  {
    const std::vector<char> filled(size, 'x');
    EXPECT_EQ(filled[size / 2], 'x');
  }
  // What was freed still counts.
  EXPECT_GE(peak_memory_bytes(MPI_COMM_WORLD), n_ranks * size);
}
