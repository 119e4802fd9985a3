// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_stop_request_h
#define perideal_base_stop_request_h

#include <mpi.h>

namespace perideal
{
  /// Catches SIGTERM and SIGINT while an object of this class exists: they ask the program to stop instead of
  /// ending it.
  class StopRequest
  {
  public:
    StopRequest();
    /// Restores the former signal handlers.
    ~StopRequest();

    StopRequest(const StopRequest &)            = delete;
    StopRequest &operator=(const StopRequest &) = delete;

    /// Whether any rank was asked to stop. Collective.
    bool is_there(MPI_Comm communicator) const;

    /// Whether this rank was.
    bool is_here() const;

  private:
    void (*before_term)(int);
    void (*before_interrupt)(int);
  };
} // namespace perideal

#endif
