// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_checkpoint_h
#define perideal_output_checkpoint_h

#include <perideal/neighbourhood/bond_list.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// What a stopped run needs to go on.
  struct Checkpoint
  {
    /// Numbers and texts that all ranks agree on.
    nlohmann::ordered_json header;
    /// Values of the owned nodes, as many for each.
    std::map<std::string, std::vector<double>> fields;
    /// Numbers of this rank whose sum over the ranks counts.
    std::vector<double> shares;
    /// Bonds of this rank that broke, in this order; those that the partition cuts may appear twice
    /// where another number of ranks goes on.
    std::vector<BondEnds> broken;

    /// A field, from and into a vector of as many numbers.
    template <typename Vector>
    void put(const std::string &name, const Vector &values)
    {
      fields[name].assign(values.begin(), values.end());
    }
    template <typename Vector>
    void take(const std::string &name, Vector &values) const
    {
      std::copy(fields.at(name).begin(), fields.at(name).end(), values.begin());
    }
  };

  /// The nodes of this rank: owned ones first, then ghosts.
  struct CheckpointNodes
  {
    /// cell_keys() of local nodes.
    std::vector<std::uint64_t> key;
    /// Global numbers of local nodes; those of the owned ones are contiguous.
    std::vector<GlobalIndex> number;
    LocalIndex               n_owned;
    GlobalIndex              n_global;
    MPI_Comm                 communicator;
  };

  /**
   * Writes the older of checkpoint_0.h5 and checkpoint_1.h5 anew, reads it back, and then names it in
   * checkpoint.json: whenever the program dies, what checkpoint.json names is whole. Collective.
   * @throws ComputationError when the file cannot be written.
   */
  void
  write_checkpoint(const std::string &directory, const Checkpoint &checkpoint, const CheckpointNodes &nodes);

  /**
   * Reads what checkpoint.json names, written by any number of ranks. By the same number, all comes back
   * bit by bit. Collective.
   * @throws InputError when there is none, it is damaged, or it belongs to another body.
   */
  Checkpoint read_checkpoint(const std::string &directory, const CheckpointNodes &nodes);
} // namespace perideal

#endif
