// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/work_progress.h>
#include <perideal/output/progress.h>
#include <perideal/problem/run.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iostream>
#include <memory>

namespace perideal
{
  Run::Run(const RunContext &context, MPI_Comm communicator)
    : context(context)
    , communicator(communicator)
    , screen(std::cout, dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , is_watched(screen.is_active() && is_on_terminal())
    , timings(communicator)
  {
    if (is_watched)
      WorkProgress::watch_by([](const std::string &what) {
        const auto bar = std::make_shared<ProgressBar>(std::cout, true, what);
        return [bar](const double share) { bar->update(share); };
      });
  }

  Run::~Run()
  {
    WorkProgress::watch_by({});
  }

  void Run::go_on(const EarlierRun &earlier)
  {
    adaptation = earlier.adaptation;
    warnings   = earlier.warnings;
    timings.add_earlier(earlier.seconds);
  }

  void Run::warn(const std::string &text)
  {
    if (std::find(warnings.begin(), warnings.end(), text) != warnings.end())
      return;
    screen << "warning     " << text << std::endl;
    warnings.push_back(text);
  }
} // namespace perideal
