// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_checkpoint_h
#define perideal_output_checkpoint_h

#include <perideal/base/exceptions.h>
#include <perideal/neighbourhood/bond_list.h>

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace perideal
{
  /// How the numbers of nodes are taken to other nodes, where cells were halved or joined.
  enum class Transfer
  {
    /// Those of the cell; the largest of cells that were joined.
    constant,
    /// By a quadratic polynomial, the sum over the cells times their volumes as it was.
    smooth,
    /// As constant ones, but the first number tells whether the node is one of a half: 1, of others 0.
    marks_halves
  };

  /// As many numbers for each owned node, one node after another.
  struct NodeArray
  {
    std::string         unit;
    unsigned int        width = 1;
    std::vector<double> values;
    Transfer            transfer = Transfer::constant;
  };

  /// Bonds of this rank in an order of their own, and as many numbers for each; none where the bonds say all.
  struct BondArray
  {
    std::string           unit;
    unsigned int          width = 0;
    std::vector<BondEnds> bonds;
    std::vector<double>   values;
  };

  /// Holds what a stopped run needs to continue.
  struct Checkpoint
  {
    /// Numbers and texts that all ranks agree on.
    nlohmann::ordered_json           header;
    std::map<std::string, NodeArray> node_arrays;
    /// Bonds that the partition cuts stand on both ranks; where another number of ranks goes on, maybe twice.
    std::map<std::string, BondArray> bond_arrays;
    /// Numbers of this rank whose sums over the ranks count.
    std::map<std::string, std::vector<double>> sums;

    /// An entry of the header.
    /// @throws InputError when there is none, or one of another type.
    template <typename T>
    T get(const std::string &name) const
    {
      try
        {
          return header.at(name).get<T>();
        }
      catch (const nlohmann::ordered_json::exception &)
        {
          throw lacks(name);
        }
    }

    /// What is thrown where a checkpoint lacks something that the scene needs.
    static InputError lacks(const std::string &name);
  };

  /// The nodes of this rank: owned ones first, then ghosts.
  struct CheckpointNodes
  {
    /// cell_keys() of local nodes.
    std::vector<std::uint64_t> key;
    LocalIndex                 n_owned;
    GlobalIndex                n_global;
    MPI_Comm                   communicator;
  };

  /**
   * Writes the older of checkpoint_0.h5 and checkpoint_1.h5 anew, reads it back, and then names it in
   * checkpoint.json, with the checksum of its header, which has those of its tables: whenever the program
   * dies, what checkpoint.json names is whole. Bonds are told by the keys of their ends. Collective.
   * @throws ComputationError on all ranks when the file cannot be written.
   */
  void
  write_checkpoint(const std::string &directory, const Checkpoint &checkpoint, const CheckpointNodes &nodes);

  /**
   * Reads what checkpoint.json names, written by any number of ranks. By the same number, all comes back
   * bit by bit. Collective.
   * @throws InputError on all ranks when there is none, it is damaged (the message names file and table), or
   * it belongs to another body.
   */
  Checkpoint read_checkpoint(const std::string &directory, const CheckpointNodes &nodes);
} // namespace perideal

#endif
