// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/stop_request.h>

#include <deal.II/base/mpi.h>

#include <csignal>

namespace perideal
{
  namespace
  {
    volatile std::sig_atomic_t stop_requested = 0;

    void request_stop(int)
    {
      stop_requested = 1;
    }
  } // namespace

  StopRequest::StopRequest()
    : before_term(std::signal(SIGTERM, request_stop))
    , before_interrupt(std::signal(SIGINT, request_stop))
  {
    stop_requested = 0;
  }

  StopRequest::~StopRequest()
  {
    std::signal(SIGTERM, before_term);
    std::signal(SIGINT, before_interrupt);
  }

  bool StopRequest::is_there(MPI_Comm communicator) const
  {
    return dealii::Utilities::MPI::max(static_cast<unsigned int>(stop_requested), communicator) != 0;
  }

  bool StopRequest::is_here() const
  {
    return stop_requested != 0;
  }
} // namespace perideal
