// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_files_h
#define perideal_output_files_h

#include <mpi.h>

#include <functional>
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

  /// Lets all ranks call what writes on the first one, and throws on all ranks what that throws. Collective.
  /// @throws ComputationError
  void write_together(MPI_Comm communicator, const std::function<void()> &write);

  /// Puts a file that was written beside another in its place, or removes it where it could not be written.
  /// For one rank. @throws ComputationError when there is no new file.
  void finish_file(const bool is_written, const std::string &part, const std::string &path);

  /**
   * Keeps other runs out of a directory for as long as it lives. The operating system ends it with the
   * process, however that ends; a file perideal.lock that is left behind keeps nobody out. Where the file
   * system has no locks, nobody is kept out.
   */
  class DirectoryLock
  {
  public:
    /// Collective. @throws InputError on all ranks when another run has the directory, naming its process.
    DirectoryLock(const std::string &directory, MPI_Comm communicator);
    ~DirectoryLock();

    DirectoryLock(const DirectoryLock &)            = delete;
    DirectoryLock &operator=(const DirectoryLock &) = delete;

  private:
    /// Rank 0: returns who holds the lock, if not this object.
    std::string take();

    std::string path;
    int         descriptor = -1;
  };

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
