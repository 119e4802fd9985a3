// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_summary_h
#define perideal_output_summary_h

#include <mpi.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Writes the summary of a run (summary.json), whole or not at all; rank 0
   * does it, from its own @p summary. JSON knows no NaN and no infinity: they
   * become null.
   * @param is_done whether the run came to its end: with such numbers it has failed
   * @throws ComputationError on the first rank when the file cannot be written; on all, with the file
   * written, naming the numbers of a run that is done which are not finite.
   */
  void write_summary(const std::string            &path,
                     const nlohmann::ordered_json &summary,
                     MPI_Comm                      communicator,
                     const bool                    is_done = false);

  /// Writes a table for the screen, columns aligned: the first to the left, the
  /// others, which hold numbers, to the right. Rows have as many cells as the header.
  std::string report_table(const std::vector<std::string>              &header,
                           const std::vector<std::vector<std::string>> &rows);

  /// A number for such a table, four digits; "-" where it is not finite.
  std::string short_number(const double value);

  /// Returns the largest resident memory so far, the sum of all ranks [B]. Collective.
  std::uint64_t peak_memory_bytes(MPI_Comm communicator);
} // namespace perideal

#endif
