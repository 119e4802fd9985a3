// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_test.h"

#include <perideal/base/exceptions.h>
#include <perideal/output/history.h>

#include <deal.II/base/hdf5.h>

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
      {
        const dealii::HDF5::File file(path, dealii::HDF5::File::FileAccessMode::open);
        values = file.open_dataset(name).read<std::vector<double>>();
      }
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
