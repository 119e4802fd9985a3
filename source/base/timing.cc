// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/timing.h>

#include <deal.II/base/mpi.h>

#include <iostream>

namespace perideal
{
  Timings::Timings(MPI_Comm communicator)
    : communicator(communicator)
    , silent(std::cout, false)
    , timer(silent, dealii::TimerOutput::never, dealii::TimerOutput::wall_times)
  {
  }

  Timings::Scope::Scope(Timings &timings, const std::string &phase)
    : scope(timings.timer, phase)
  {
  }

  std::map<std::string, double> Timings::seconds() const
  {
    auto result = timer.get_summary_data(dealii::TimerOutput::total_wall_time);
    for (auto &phase : result)
      phase.second = dealii::Utilities::MPI::max(phase.second, communicator);
    result["total"] = dealii::Utilities::MPI::max(total.wall_time(), communicator);
    for (const auto &[phase, of_phase] : earlier)
      result[phase] += of_phase;
    return result;
  }

  void Timings::add_earlier(const std::map<std::string, double> &phases)
  {
    for (const auto &[phase, of_phase] : phases)
      earlier[phase] += of_phase;
  }
} // namespace perideal
