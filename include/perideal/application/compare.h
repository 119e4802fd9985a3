// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_compare_h
#define perideal_application_compare_h

#include <nlohmann/json.hpp>

#include <string>

namespace perideal
{
  /// Two summaries side by side: a table of their figures with the differences, relative to the first run,
  /// and a table of the parameters that differ. Lists of more than three numbers are left out.
  std::string compare_summaries(const nlohmann::ordered_json &one, const nlohmann::ordered_json &other);

  /// The same for the runs that left their results in two directories.
  /// @throws InputError where one of them has no summary.json
  std::string compare_runs(const std::string &one, const std::string &other);
} // namespace perideal

#endif
