// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_timing_h
#define perideal_base_timing_h

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/timer.h>

#include <mpi.h>

#include <map>
#include <string>

namespace perideal
{
  /**
   * Measures wall time by phase. This wraps dealii::TimerOutput and adds the
   * agreement between ranks (the slowest counts).
   */
  class Timings
  {
  public:
    explicit Timings(MPI_Comm communicator);

    /// Measures from construction to destruction; scopes may be nested, and
    /// scopes of one name add up.
    class Scope
    {
    public:
      Scope(Timings &timings, const std::string &phase);

    private:
      dealii::TimerOutput::Scope scope;
    };

    /// Seconds of every phase, the slowest rank's, in alphabetical order, and
    /// "total" since construction. Collective.
    std::map<std::string, double> seconds() const;

    /// Counts the seconds of an earlier part of the run, as seconds() gives them.
    void add_earlier(const std::map<std::string, double> &phases);

  private:
    MPI_Comm                      communicator;
    dealii::ConditionalOStream    silent;
    mutable dealii::TimerOutput   timer;
    mutable dealii::Timer         total;
    std::map<std::string, double> earlier;
  };
} // namespace perideal

#endif
