// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_gate_h
#define perideal_application_gate_h

#include <functional>

namespace perideal
{
  /**
   * Runs an action, and makes of whatever it throws one message on standard error and an exit status: 0 done,
   * 1 the input is wrong, 2 the computation failed or was stopped. Where a single rank may have failed, the
   * others are ended with it.
   */
  int run_guarded(const std::function<void()> &action);
} // namespace perideal

#endif
