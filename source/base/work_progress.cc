// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/work_progress.h>

namespace perideal
{
  namespace
  {
    WorkProgress::Watch &watch_of_program()
    {
      static WorkProgress::Watch watch;
      return watch;
    }
  } // namespace

  void WorkProgress::watch_by(const Watch &watch)
  {
    watch_of_program() = watch;
  }

  WorkProgress::WorkProgress(const std::string &what, const std::size_t n)
    : show(watch_of_program() ? watch_of_program()(what) : Show())
    , n(n)
  {
  }
} // namespace perideal
