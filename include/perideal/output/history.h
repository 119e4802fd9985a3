// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_history_h
#define perideal_output_history_h

#include <boost/crc.hpp>
#include <mpi.h>

#include <cstdint>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Records numbers that change from step to step (energies, reactions, probes): a row
   * a step in history.csv, which is on disk as soon as the row ends, and at the
   * end the same columns as one-dimensional data sets in history.h5.
   *
   * All ranks may call all functions with values that all ranks agree on; rank
   * 0 writes them. Only the constructor communicates.
   */
  class History
  {
  public:
    /// Begins a new history.csv, or goes on with the one there. Collective.
    /// @param last_step of the rows to keep, by their first column; negative: a new history
    /// @param checksum of these rows, where it is known
    /// @throws InputError on all ranks when the directory cannot be written, or when the rows are others.
    History(const std::string                 &directory,
            MPI_Comm                           communicator,
            const double                       last_step = -1,
            const std::optional<std::uint32_t> checksum  = {});

    /// Tries to finish(), so that what was computed stays when an error ends the run; without a word where it
    /// cannot, since that error is told and the rows are in history.csv.
    ~History();

    History(const History &)            = delete;
    History &operator=(const History &) = delete;

    /// A value of the current row. @param name with its unit, "time [s]".
    void add(const std::string &name, const double value);

    /// Completes the row. The first row fixes names and order of the columns;
    /// later rows must repeat them.
    /// @throws ComputationError on the first rank when the row cannot be written; InputError on all when the
    /// earlier rows, with which the history goes on, have other columns.
    void end_row();

    /// An array besides the columns, for history.h5 alone (the residuals of a
    /// linear solve, for instance); one of the same name is replaced.
    void add_series(const std::string &name, const std::vector<double> &values);

    /// All arrays so far, by name, on every rank.
    const std::map<std::string, std::vector<double>> &all_series() const { return series; }

    /// That of the rows so far, for those who go on from here. Collective.
    std::uint32_t checksum() const;

    /// What the user should know of the history that goes on; empty: nothing.
    const std::string &warning() const { return earlier.warning; }

    /// Writes history.h5; nothing can be added afterwards. A '/' in a name, which
    /// HDF5 keeps for groups, is written as '|'.
    /// @throws ComputationError on the first rank when it cannot be written.
    void finish();

  private:
    /// Rank 0: takes the rows of the history.csv there; returns what is wrong with them.
    std::string read_rows(const double last_step, const std::optional<std::uint32_t> checksum);
    void        keep_row(const std::vector<double> &row);
    /// @throws InputError
    void refuse(const std::string &problem) const;

    std::string   directory;
    MPI_Comm      communicator;
    bool          is_writer;
    bool          is_finished = false;
    std::ofstream csv;

    struct Row
    {
      std::vector<std::string> names;
      std::vector<double>      values;
    };
    Row                                        next_row;
    std::vector<std::string>                   column_names;
    std::vector<std::vector<double>>           columns;
    std::map<std::string, std::vector<double>> series;

    /// Of the rows, on rank 0.
    boost::crc_32_type rows_crc;

    /// What there is of an earlier run: whether the columns are its own, and what to say of it.
    struct Earlier
    {
      bool        has_columns = false;
      std::string warning;
    };
    Earlier earlier;
  };
} // namespace perideal

#endif
