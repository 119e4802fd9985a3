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
