// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/rendezvous.h>

#include <chrono>
#include <thread>

namespace perideal
{
  bool all_ranks_arrive(MPI_Comm communicator, const double seconds)
  {
    const double start = MPI_Wtime();
    MPI_Request  request;
    MPI_Ibarrier(communicator, &request);
    int arrived = 0;
    while (MPI_Test(&request, &arrived, MPI_STATUS_IGNORE) == MPI_SUCCESS && arrived == 0 &&
           MPI_Wtime() - start < seconds)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return arrived != 0;
  }
} // namespace perideal
