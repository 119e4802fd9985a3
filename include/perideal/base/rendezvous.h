// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_rendezvous_h
#define perideal_base_rendezvous_h

#include <mpi.h>

namespace perideal
{
  /**
   * Whether all ranks come to this line within some seconds: an error may have struck one rank alone, while
   * the others wait for it elsewhere and no collective function may follow.
   */
  bool all_ranks_arrive(MPI_Comm communicator, const double seconds = 3.);
} // namespace perideal

#endif
