// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/output/summary.h>
#include <perideal/recorders/report.h>

#include <cmath>

namespace perideal
{
  using Json = nlohmann::ordered_json;

  std::string timing_table(const std::map<std::string, double> &seconds)
  {
    std::vector<std::vector<std::string>> rows;
    const double                          total  = seconds.at("total");
    auto                                  phases = seconds;
    phases.erase("total");
    for (const auto &[phase, taken] : phases)
      rows.push_back({phase,
                      short_number(taken),
                      std::to_string(static_cast<int>(std::lround(100 * taken / total))) + " %"});
    rows.push_back({"total", short_number(total), "100 %"});
    return report_table({"phase", "seconds", "share"}, rows);
  }

  namespace
  {
    void
    add_error_rows(const Json &errors, const std::string &title, std::vector<std::vector<std::string>> &rows)
    {
      const auto number = [](const Json &value) {
        return value.is_number() ? short_number(value.get<double>()) : std::string("-");
      };
      rows.push_back({title, number(errors.at("l2")), number(errors.at("max"))});
      if (errors.contains("profiles"))
        for (const auto &profile : errors["profiles"].items())
          for (const auto &component : profile.value().items())
            rows.push_back(
              {"  " + component.key() + " along " + profile.key(), "", number(component.value())});
      for (const auto &item : errors.items())
        if (item.value().is_object() && item.value().contains("l2"))
          add_error_rows(item.value(), title + ", " + item.key(), rows);
    }
  } // namespace

  std::string error_table(const Json &errors)
  {
    std::vector<std::vector<std::string>> rows;
    for (const auto &comparison : errors.items())
      add_error_rows(comparison.value(), "against " + comparison.key(), rows);
    return report_table({"relative error", "l2", "max"}, rows);
  }
} // namespace perideal
