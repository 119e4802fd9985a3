// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_checkpoint_file_h
#define perideal_output_checkpoint_file_h

#include <perideal/base/hdf5.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace perideal
{
  /// What checkpoint.json says of the last checkpoint.
  struct CheckpointPointer
  {
    /// Rank 0 reads. Collective.
    static CheckpointPointer read(const std::string &directory, MPI_Comm communicator);

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &file &checksum &problem;
    }

    std::string   file;
    std::uint32_t checksum = 0;
    /// Why it cannot be read; empty: it can.
    std::string problem;
  };

  /**
   * The file of a checkpoint as one rank reads it. The header, a JSON text, has for each table its unit,
   * numbers a line, lines and checksums by the rank that wrote them:
   *
   *     {"format", "nodes" (of all ranks), "content" (Checkpoint::header), "tables": {NAME: {...}}}
   */
  class CheckpointFile
  {
  public:
    using Json = nlohmann::ordered_json;

    /// What files of another layout have another number of.
    static constexpr unsigned int format = 2;

    /// @throws hdf5::Unreadable when the header is not the one of that checksum.
    CheckpointFile(const std::string &path, const std::uint32_t header_checksum);

    /// Holds this rank's share of the tables against their checksums. @throws hdf5::Unreadable naming a
    /// table.
    void verify(const unsigned int rank, const unsigned int n_ranks) const;

    const Json &header() const { return header_tree; }
    const Json &tables() const { return header_tree.at("tables"); }

    /// Where the lines of each rank that wrote a table begin, and where the last end.
    std::vector<std::uint64_t> begin_of_ranks(const std::string &table) const;

    /// In the place of a rank: all lines.
    static constexpr unsigned int all = std::numeric_limits<unsigned int>::max();

    /// Calls visit(line, values of the line) with the lines that a rank wrote, or with all.
    template <typename Number, typename Visit>
    void visit_lines(const std::string &table, const unsigned int rank, const Visit &visit) const
    {
      const auto          begin   = begin_of_ranks(table);
      const std::uint64_t at_once = 1 << 20, first = rank == all ? 0 : begin.at(rank);
      const std::uint64_t last = rank == all ? begin.back() : begin.at(rank + 1);
      for (std::uint64_t at = first; at < last; at += at_once)
        {
          const std::uint64_t n      = std::min(at_once, last - at);
          const auto          values = file.read<Number>(table, at, n);
          for (std::uint64_t line = 0; line < n; ++line)
            visit(at + line, values.data() + line * (values.size() / n));
        }
    }

  private:
    hdf5::Unreadable damaged(const std::string &table) const;

    template <typename Number>
    void verify(const std::string &table, const unsigned int rank, const unsigned int n_ranks) const;

    std::string  path;
    hdf5::Reader file;
    Json         header_tree;
  };
} // namespace perideal

#endif
