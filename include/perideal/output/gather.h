// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_gather_h
#define perideal_output_gather_h

#include <deal.II/base/mpi.h>

#include <vector>

namespace perideal
{
  /// Returns on rank 0 the values of all ranks, one rank after the other. Collective.
  template <typename T>
  std::vector<T> gather(const std::vector<T> &mine, MPI_Comm communicator)
  {
    std::vector<T> all;
    for (const auto &part : dealii::Utilities::MPI::gather(communicator, mine, 0))
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }
} // namespace perideal

#endif
