// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_files_h
#define perideal_output_files_h

#include <mpi.h>

#include <ostream>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Creates the directory with its parents and tries to write a file in it.
   * Collective.
   * @throws InputError on all ranks, naming the parameter "Output directory".
   */
  void create_output_directory(const std::string &directory, MPI_Comm communicator);

  /**
   * Writes the text under a temporary name and renames it, so that at any time
   * the file is either the old or the new one, never a part. For one rank.
   * @throws ComputationError when the file cannot be written.
   */
  void replace_file(const std::string &path, const std::string &text);

  /// One line of a CSV file of texts, quoted where they hold a comma or a quote (RFC 4180).
  void write_csv_header(std::ostream &out, const std::vector<std::string> &names);

  /// One line of a CSV file of numbers with the 17 digits that make reading exact.
  void write_csv_row(std::ostream &out, const std::vector<double> &values);

  /// What write_csv_header() and write_csv_row() wrote, from a line without its end; a row stops at what is
  /// no number.
  std::vector<std::string> read_csv_header(const std::string &line);
  std::vector<double>      read_csv_row(const std::string &line);

  /// A whole CSV file, as replace_file(). For one rank.
  void write_csv(const std::string                      &path,
                 const std::vector<std::string>         &header,
                 const std::vector<std::vector<double>> &rows);
} // namespace perideal

#endif
