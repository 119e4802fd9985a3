// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/hdf5.h>
#include <perideal/base/links.h>
#include <perideal/output/files.h>
#include <perideal/output/history.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// The first column that is another one.
    std::string first_difference(const std::vector<std::string> &there, const std::vector<std::string> &here)
    {
      const auto [a, b] = std::mismatch(there.begin(), there.end(), here.begin(), here.end());
      const auto name   = [](const auto at, const auto end) {
        return at == end ? std::string("no more") : "'" + *at + "'";
      };
      return name(a, there.end()) + " there, " + name(b, here.end()) + " here";
    }
  } // namespace

  History::History(const std::string                 &directory,
                   MPI_Comm                           communicator,
                   const double                       last_step,
                   const std::optional<std::uint32_t> checksum)
    : directory(directory)
    , communicator(communicator)
    , is_writer(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    using dealii::Utilities::MPI::broadcast;
    create_output_directory(directory, communicator);
    const std::string problem =
      broadcast(communicator, is_writer && last_step >= 0 ? read_rows(last_step, checksum) : "", 0);
    if (!problem.empty())
      refuse(problem);
    earlier.warning     = broadcast(communicator, earlier.warning, 0);
    column_names        = broadcast(communicator, column_names, 0);
    earlier.has_columns = !column_names.empty();
    columns.resize(column_names.size());
    if (is_writer)
      {
        remove_link(directory + "/history.csv");
        csv.open(directory + "/history.csv", earlier.has_columns ? std::ios::app : std::ios::out);
      }
    if (!broadcast(communicator, csv.is_open() || !is_writer, 0))
      throw InputError("history.csv cannot be written in the output directory")
        .parameter("Output directory")
        .given(directory)
        .allowed("a directory in which you may write, without a directory or a protected file of this name");
  }

  void History::refuse(const std::string &problem) const
  {
    throw InputError(problem)
      .parameter("Checkpoints/Restart")
      .given(directory + "/history.csv")
      .hint("put back the history.csv of the earlier run, or move it away: a new one is begun");
  }

  void History::keep_row(const std::vector<double> &row)
  {
    for (std::size_t column = 0; column < columns.size(); ++column)
      columns[column].push_back(row[column]);
    rows_crc.process_bytes(row.data(), row.size() * sizeof(double));
  }

  std::string History::read_rows(const double last_step, const std::optional<std::uint32_t> checksum)
  {
    const std::string path = directory + "/history.csv";
    std::ifstream     file(path);
    std::string       line;
    if (!std::getline(file, line))
      {
        earlier.warning = "there is no history.csv of the steps before the checkpoint: a new one begins here";
        return "";
      }
    column_names = read_csv_header(line);
    columns.resize(column_names.size());
    std::vector<std::vector<double>> rows;
    while (std::getline(file, line))
      {
        const std::vector<double> row = read_csv_row(line);
        // The last line may be a part.
        if (row.size() == column_names.size() && row.front() <= last_step)
          {
            keep_row(row);
            rows.push_back(row);
          }
      }
    file.close();
    if (checksum && rows_crc.checksum() != *checksum)
      return "the rows of history.csv are not those of the run that wrote the checkpoint";
    write_csv(path, column_names, rows);
    return "";
  }

  History::~History()
  {
    try
      {
        finish();
      }
    catch (...)
      {
      }
  }

  std::uint32_t History::checksum() const
  {
    return dealii::Utilities::MPI::broadcast(communicator, rows_crc.checksum(), 0);
  }

  void History::add(const std::string &name, const double value)
  {
    next_row.names.push_back(name);
    next_row.values.push_back(value);
  }

  void History::end_row()
  {
    Assert(!is_finished, dealii::ExcMessage("finish() was called before"));
    if (columns.empty())
      {
        column_names = next_row.names;
        columns.resize(column_names.size());
        if (is_writer)
          write_csv_header(csv, column_names);
      }
    if (earlier.has_columns && next_row.names != column_names)
      refuse("history.csv has other columns than this run: " +
             first_difference(column_names, next_row.names));
    AssertThrow(next_row.names == column_names, dealii::ExcMessage("a row of the history has other columns"));
    earlier.has_columns = false;
    if (is_writer)
      {
        keep_row(next_row.values);
        write_csv_row(csv, next_row.values);
        csv.flush();
        if (!csv)
          throw ComputationError("cannot write '" + directory + "/history.csv': is the disk full?");
      }
    next_row.names.clear();
    next_row.values.clear();
  }

  void History::add_series(const std::string &name, const std::vector<double> &values)
  {
    Assert(!is_finished, dealii::ExcMessage("finish() was called before"));
    series[name] = values;
  }

  void History::finish()
  {
    if (is_finished)
      return;
    is_finished = true;
    if (!is_writer)
      return;
    csv.close();

    // Beside the file there, which stays whole until this one is.
    const std::string path = directory + "/history.h5", part = path + ".part";
    bool              is_written = false;
    try
      {
        hdf5::Writer file(part, MPI_COMM_SELF);
        const auto   write = [&](std::string name, const std::vector<double> &values) {
          std::replace(name.begin(), name.end(), '/', '|');
          file.write(name, values, {values.size()});
        };
        for (std::size_t column = 0; column < columns.size(); ++column)
          write(column_names[column], columns[column]);
        for (const auto &item : series)
          write(item.first, item.second);
        file.close();
        is_written = true;
      }
    catch (const ComputationError &)
      {
        // The name that the user knows is told.
      }
    finish_file(is_written, part, path);
  }
} // namespace perideal
