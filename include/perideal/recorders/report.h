// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_recorders_report_h
#define perideal_recorders_report_h

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace perideal
{
  /// Returns a table of seconds by phase.
  std::string timing_table(const std::map<std::string, double> &seconds);

  /// Returns a table of errors from the "errors" part of summary.json.
  std::string error_table(const nlohmann::ordered_json &errors);
} // namespace perideal

#endif
