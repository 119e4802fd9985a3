// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/output/files.h>
#include <perideal/output/history.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iostream>

namespace perideal
{
  History::History(const std::string &directory, MPI_Comm communicator, const double last_step)
    : directory(directory)
    , is_writer(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
    create_output_directory(directory, communicator);
    if (is_writer && last_step >= 0)
      read_rows(last_step);
    column_names = dealii::Utilities::MPI::broadcast(communicator, column_names, 0);
    columns.resize(column_names.size());
    if (is_writer)
      csv.open(directory + "/history.csv", columns.empty() ? std::ios::out : std::ios::app);
  }

  void History::read_rows(const double last_step)
  {
    const std::string        path = directory + "/history.csv";
    std::ifstream            file(path);
    std::string              line;
    std::vector<std::string> names;
    if (std::getline(file, line))
      names = read_csv_header(line);
    std::vector<std::vector<double>> rows;
    while (std::getline(file, line))
      {
        const std::vector<double> row = read_csv_row(line);
        // The last line may be a part.
        if (row.size() == names.size() && !row.empty() && row.front() <= last_step)
          rows.push_back(row);
      }
    file.close();
    if (rows.empty())
      return;
    column_names = names;
    columns.resize(names.size());
    for (const auto &row : rows)
      for (std::size_t column = 0; column < row.size(); ++column)
        columns[column].push_back(row[column]);
    write_csv(path, names, rows);
  }

  History::~History()
  {
    try
      {
        finish();
      }
    catch (const std::exception &error)
      {
        std::cerr << "history.h5 could not be written: " << error.what() << std::endl;
      }
  }

  void History::add(const std::string &name, const double value)
  {
    row_names.push_back(name);
    row_values.push_back(value);
  }

  void History::end_row()
  {
    Assert(!is_finished, dealii::ExcMessage("finish() was called before"));
    if (columns.empty())
      {
        column_names = row_names;
        columns.resize(column_names.size());
        if (is_writer)
          write_csv_header(csv, column_names);
      }
    AssertThrow(row_names == column_names, dealii::ExcMessage("a row of the history has other columns"));
    if (is_writer)
      {
        for (std::size_t column = 0; column < columns.size(); ++column)
          columns[column].push_back(row_values[column]);
        write_csv_row(csv, row_values);
        csv.flush();
        if (!csv)
          throw ComputationError("cannot write '" + directory + "/history.csv': is the disk full?");
      }
    row_names.clear();
    row_values.clear();
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

    const dealii::HDF5::File file(directory + "/history.h5", dealii::HDF5::File::FileAccessMode::create);
    const auto               write = [&](std::string name, const std::vector<double> &values) {
      std::replace(name.begin(), name.end(), '/', '|');
      file.write_dataset(name, values);
    };
    for (std::size_t column = 0; column < columns.size(); ++column)
      write(column_names[column], columns[column]);
    for (const auto &[name, values] : series)
      write(name, values);
  }
} // namespace perideal
