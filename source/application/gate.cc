// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/gate.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/rendezvous.h>

#include <deal.II/base/mpi.h>

#include <iostream>
#include <new>
#include <string>

namespace perideal
{
  namespace
  {
    void say(const std::string &message)
    {
      std::cerr << "perideal: " << message << std::endl;
    }

    /// Tells why the program ends, once where all ranks end alike; where one rank failed alone, it ends the
    /// others, which wait for it. Returns the exit status.
    int end(const std::string &message, const int status)
    {
      const bool alike = all_ranks_arrive(MPI_COMM_WORLD);
      if (!alike || dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        say(message);
      if (!alike)
        MPI_Abort(MPI_COMM_WORLD, status);
      return status;
    }
  } // namespace

  int run_guarded(const std::function<void()> &action)
  {
    try
      {
        action();
        return 0;
      }
    catch (const InputError &error)
      {
        return end(std::string("input error: ") + error.what(), 1);
      }
    catch (const Stopped &stop)
      {
        return end(std::string("stopped: ") + stop.what(), 2);
      }
    catch (const ComputationError &error)
      {
        return end(std::string("computation failed: ") + error.what(), 2);
      }
    catch (const std::bad_alloc &)
      {
        return end("computation failed: out of memory\n  advice: perideal --check shows what a scene needs",
                   2);
      }
    catch (const std::exception &error)
      {
        return end(std::string("internal error: ") + error.what(), 2);
      }
  }
} // namespace perideal
