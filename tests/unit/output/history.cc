// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_test.h"

#include <perideal/base/exceptions.h>
#include <perideal/base/hdf5.h>
#include <perideal/output/history.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

using namespace perideal;
using namespace output_test;

namespace
{
  /// Rank 0 reads, as it is rank 0 that wrote; all ranks get the values.
  std::vector<double> read_dataset(const std::string &path, const std::string &name)
  {
    std::vector<double> values;
    if (is_first_rank())
      values = hdf5::Reader(path).read<double>(name);
    return dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, values, 0);
  }

  void add_row(History &history, const unsigned int step)
  {
    history.add("time [s]", 0.1 * step);
    history.add("reaction left [N/m]", std::sqrt(2. + step));
    history.end_row();
  }
} // namespace

TEST(History, CsvIsCompleteAfterEveryRow)
{
  const auto directory = scratch_directory("history_rows");
  History    history(directory, MPI_COMM_WORLD);
  for (unsigned int step = 0; step < 3; ++step)
    {
      add_row(history, step);
      const auto lines = read_lines(directory + "/history.csv");
      ASSERT_EQ(lines.size(), step + 2);
      EXPECT_EQ(lines[0], "time [s],reaction left [N/m]");
      const auto rows = read_csv(directory + "/history.csv");
      EXPECT_EQ(rows[step], (std::vector<double>{0.1 * step, std::sqrt(2. + step)}));
      MPI_Barrier(MPI_COMM_WORLD);
    }
}

TEST(History, Hdf5HoldsColumnsAndSeriesExactly)
{
  const auto                directory = scratch_directory("history_h5");
  const std::vector<double> residuals = {1, 1e-3, 1. / 3e7};
  History                   history(directory, MPI_COMM_WORLD);
  add_row(history, 0);
  add_row(history, 1);
  history.add_series("residuals of step 1", {5});
  history.add_series("residuals of step 1", residuals);
  history.add_series("nothing", {});
  history.finish();

  const std::string file = directory + "/history.h5";
  EXPECT_EQ(read_dataset(file, "time [s]"), (std::vector<double>{0, 0.1}));
  EXPECT_EQ(read_dataset(file, "reaction left [N|m]"), (std::vector<double>{std::sqrt(2.), std::sqrt(3.)}));
  EXPECT_EQ(read_dataset(file, "residuals of step 1"), residuals);
  EXPECT_TRUE(read_dataset(file, "nothing").empty());
}

TEST(History, DestructorFinishes)
{
  const auto directory = scratch_directory("history_destructor");
  {
    History history(directory, MPI_COMM_WORLD);
    add_row(history, 4);
  }
  EXPECT_EQ(read_dataset(directory + "/history.h5", "time [s]"), (std::vector<double>{0.4}));
}

TEST(History, RefusesARowWithOtherColumns)
{
  History history(scratch_directory("history_columns"), MPI_COMM_WORLD);
  add_row(history, 0);
  history.add("time [s]", 1);
  EXPECT_THROW(history.end_row(), dealii::ExceptionBase);
}

TEST(History, UnwritableDirectoryIsAnInputError)
{
  EXPECT_THROW(History("/dev/null/below", MPI_COMM_WORLD), InputError);
}

TEST(History, AFullDiskIsToldOnceAndTheRowsStay)
{
  const auto directory = scratch_directory("history_full");
  testing::internal::CaptureStderr();
  {
    History history(directory, MPI_COMM_WORLD);
    add_row(history, 0);
    history.add_series("residuals", std::vector<double>(100000, 1.));
    if (is_first_rank())
      {
        std::filesystem::create_symlink("/dev/full", directory + "/history.h5.part");
        EXPECT_THROW(history.finish(), ComputationError);
      }
  }
  {
    // The destructor tries again, without a word.
    History history(directory, MPI_COMM_WORLD, 1.);
    add_row(history, 1);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(read_csv(directory + "/history.csv").size(), 2u);
}

TEST(History, GoesOnWithTheRowsOfTheCheckpointOnly)
{
  const auto    directory = scratch_directory("history_goes_on");
  std::uint32_t checksum  = 0;
  {
    History history(directory, MPI_COMM_WORLD);
    add_row(history, 0);
    add_row(history, 1);
    checksum = history.checksum();
    add_row(history, 2);
  }
  const std::string written = read_text(directory + "/history.csv");
  {
    History history(directory, MPI_COMM_WORLD, 0.15, checksum);
    EXPECT_EQ(history.checksum(), checksum);
    EXPECT_EQ(history.warning(), "");
    add_row(history, 2);
  }
  EXPECT_EQ(read_text(directory + "/history.csv"), written);
}

TEST(History, OtherRowsAndColumnsAreRefusedAndLostOnesAreTold)
{
  const auto    directory = scratch_directory("history_other");
  const auto    path      = directory + "/history.csv";
  std::uint32_t checksum  = 0;
  {
    History history(directory, MPI_COMM_WORLD);
    add_row(history, 0);
    add_row(history, 1);
    checksum = history.checksum();
  }
  std::string text = read_text(path);
  MPI_Barrier(MPI_COMM_WORLD);
  {
    History history(directory, MPI_COMM_WORLD, 1., checksum);
    history.add("time [s]", 0.2);
    history.add("reaction right [N/m]", 1.);
    try
      {
        history.end_row();
        ADD_FAILURE() << "other columns are accepted";
      }
    catch (const InputError &error)
      {
        for (const char *word : {"history.csv", "'reaction left [N/m]' there", "'reaction right [N/m]' here"})
          EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
      }
  }
  text[text.find("1.4142") + 2] ^= 1;
  if (is_first_rank())
    std::ofstream(path) << text;
  MPI_Barrier(MPI_COMM_WORLD);
  EXPECT_THROW(History(directory, MPI_COMM_WORLD, 1., checksum), InputError);
  MPI_Barrier(MPI_COMM_WORLD);
  if (is_first_rank())
    std::filesystem::remove(path);
  MPI_Barrier(MPI_COMM_WORLD);
  const History history(directory, MPI_COMM_WORLD, 1., checksum);
  EXPECT_NE(history.warning().find("no history.csv"), std::string::npos);
}
