// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_stop_request_h
#define perideal_base_stop_request_h

#include <mpi.h>

namespace perideal
{
  /// As long as an object of this class lives, SIGTERM and SIGINT do not end the program but ask it to stop.
  class StopRequest
  {
  public:
    StopRequest();
    /// Gives the signals back what they did before.
    ~StopRequest();

    StopRequest(const StopRequest &)            = delete;
    StopRequest &operator=(const StopRequest &) = delete;

    /// Whether any rank was asked to stop. Collective.
    bool is_there(MPI_Comm communicator) const;

  private:
    void (*before_term)(int);
    void (*before_interrupt)(int);
  };
} // namespace perideal

#endif
