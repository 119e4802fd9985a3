// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_combinations_h
#define perideal_application_combinations_h

#include <iosfwd>

namespace perideal
{
  /// Prints as markdown with which solvers and other choices each model is accepted, found by applying the
  /// table of rules.
  void print_combinations(std::ostream &out);
} // namespace perideal

#endif
