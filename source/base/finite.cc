// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/finite.h>

#include <nlohmann/json.hpp>

namespace perideal
{
  double require_finite(const double value, const std::string &what)
  {
    if (!is_finite(value))
      throw ComputationError(what + (std::isnan(value) ? " is not a number" : " is infinite") +
                             "\n  likely cause: loads or material constants so large or small that "
                             "numbers overflow, or a formula that divides by zero");
    return value;
  }

  nlohmann::ordered_json number_or_null(const double value)
  {
    return is_finite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
  }

  nlohmann::ordered_json numbers_or_null(const std::vector<double> &values)
  {
    auto result = nlohmann::ordered_json::array();
    for (const double value : values)
      result.push_back(number_or_null(value));
    return result;
  }

  std::vector<std::string> non_finite_paths(const nlohmann::ordered_json &tree)
  {
    std::vector<std::string> result;
    if (tree.is_number_float() && !is_finite(tree.get<double>()))
      result.emplace_back();
    if (tree.is_structured())
      for (const auto &item : tree.items())
        for (const std::string &path : non_finite_paths(item.value()))
          result.push_back("/" + item.key() + path);
    return result;
  }
} // namespace perideal
