// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_checkpoint_file_h
#define perideal_output_checkpoint_file_h

#include <perideal/base/hdf5.h>
#include <perideal/output/checkpoint.h>

#include <limits>

namespace perideal
{
  /// Writes the tables of a checkpoint and a header with their checksums; returns the header. Collective.
  std::string
  write_checkpoint_file(const std::string &path, const Checkpoint &checkpoint, const CheckpointNodes &nodes);

  /// Reads a checkpoint file by one rank. Functions throw hdf5::Unreadable.
  class CheckpointFile
  {
  public:
    /// @throws hdf5::Unreadable when the header is not the one of that checksum.
    CheckpointFile(const std::string &path, const std::uint32_t header_checksum);

    /// Compares this rank's share of the tables with their checksums.
    void verify(const unsigned int rank, const unsigned int n_ranks) const;

    /// Whether as many ranks with the same nodes wrote the file: the answer for this rank.
    bool is_as_written(const CheckpointNodes &nodes) const;

    /// Stands for the lines of all ranks.
    static constexpr unsigned int all = std::numeric_limits<unsigned int>::max();

    /// Returns what belongs to the nodes and bonds of this rank, from the lines that a rank wrote or from
    /// all; of these the first rank takes the sums.
    Checkpoint read(const CheckpointNodes &nodes, const unsigned int rank) const;

    const nlohmann::ordered_json &tables() const { return header.at("tables"); }

    /// Calls visit(line, values of the line) with the lines that a rank wrote, or with all.
    template <typename Number, typename Visit>
    void visit_lines(const std::string &name, const unsigned int rank, const Visit &visit) const;

    /// {"nodes": of all ranks, "content": Checkpoint::header, "tables": what their lines are}
    nlohmann::ordered_json header;

  private:
    hdf5::Unreadable damaged(const std::string &table) const;

    template <typename Number>
    void verify(const std::string &name, const unsigned int rank, const unsigned int n_ranks) const;

    const std::string  path;
    const hdf5::Reader file;
  };
} // namespace perideal

#endif
