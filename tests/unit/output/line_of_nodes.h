// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_line_of_nodes_h
#define perideal_tests_line_of_nodes_h

#include <perideal/output/checkpoint.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace output_test
{
  /// Nodes 0, 1, ... in a row, in blocks by rank, each a neighbour of the next one.
  struct LineOfNodes
  {
    LineOfNodes(const unsigned int n, MPI_Comm communicator)
    {
      const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
      const unsigned int begin = n * rank / n_ranks, end = n * (rank + 1) / n_ranks;
      for (unsigned int i = begin; i < end; ++i)
        number.push_back(i);
      if (begin > 0)
        number.push_back(begin - 1);
      if (end < n)
        number.push_back(end);
      nodes = {{}, end - begin, n, communicator};
      for (const unsigned int i : number)
        nodes.key.push_back((std::uint64_t(3) << 60) + 7 * i);
    }

    bool is_owned(const perideal::LocalIndex i) const { return i < nodes.n_owned; }

    perideal::LocalIndex local(const unsigned int i) const
    {
      return std::find(number.begin(), number.end(), i) - number.begin();
    }

    /// The bonds of this rank in the order of the nodes, the owned end first.
    std::vector<perideal::BondEnds> bonds() const
    {
      std::vector<perideal::BondEnds> result;
      for (unsigned int i = 0; i + 1 < nodes.n_global; ++i)
        {
          const perideal::LocalIndex a = local(i), b = local(i + 1);
          if (std::max(a, b) < number.size() && std::min(a, b) < nodes.n_owned)
            result.push_back({std::min(a, b), std::max(a, b)});
        }
      return result;
    }

    std::vector<unsigned int> number;
    perideal::CheckpointNodes nodes;
  };
} // namespace output_test

#endif
