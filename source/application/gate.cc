// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/gate.h>
#include <perideal/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <iostream>
#include <new>
#include <string>
#include <thread>

namespace perideal
{
  namespace
  {
    void say(const std::string &message)
    {
      std::cerr << "perideal: " << message << std::endl;
    }

    /// Ends the ranks that wait for one that failed.
    int fail_all()
    {
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, 2);
      return 2;
    }
  } // namespace

  int run_guarded(const std::function<void()> &action)
  {
    const bool is_first = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    try
      {
        action();
        return 0;
      }
    // The first two are thrown by all ranks alike.
    catch (const InputError &error)
      {
        if (is_first)
          say(std::string("input error: ") + error.what());
        return 1;
      }
    catch (const Stopped &stop)
      {
        if (is_first)
          say(std::string("stopped: ") + stop.what());
        return 2;
      }
    catch (const ComputationError &error)
      {
        // Where all ranks fail alike, the first speaks and ends the others.
        if (!is_first)
          std::this_thread::sleep_for(std::chrono::seconds(1));
        say(std::string("computation failed: ") + error.what());
      }
    catch (const std::bad_alloc &)
      {
        say("computation failed: out of memory\n  advice: perideal --check shows what a scene needs");
      }
    catch (const std::exception &error)
      {
        say(std::string("internal error: ") + error.what());
      }
    return fail_all();
  }
} // namespace perideal
