// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_child_process_h
#define perideal_base_child_process_h

#include <functional>
#include <string>
#include <vector>

namespace perideal
{
  /// How another program ended, and what it printed.
  struct ChildResult
  {
    /// Its exit status, or 128 + the signal that ended it.
    int         status = 0;
    std::string out, err;
    /// Why it could not be started at all; empty: it was.
    std::string not_started;
  };

  /**
   * Runs another program to its end, in a process group of its own, with nothing to read and without the
   * variables that mpirun sets: a program linked with MPI would take itself for a rank of this run.
   *
   * @param arguments its name, which is looked up in PATH where it has no slash, and what follows
   * @param watch called with the seconds since the start, ten times a second; when it throws, the program and
   *   what it started are ended, and the exception goes on
   */
  ChildResult run_child(std::vector<std::string>                         arguments,
                        const std::function<void(const double seconds)> &watch);
} // namespace perideal

#endif
