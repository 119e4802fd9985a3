// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_finite_h
#define perideal_base_finite_h

#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace perideal
{
  /// The one test that numbers pass which come in (formulas, files) or go out (residuals, summary).
  inline bool is_finite(const double value)
  {
    return std::isfinite(value);
  }

  /// Whether all numbers of a range (a std::vector, the local elements of a NodalVector) are finite.
  template <typename Range>
  bool is_finite(const Range &values)
  {
    return std::all_of(values.begin(), values.end(), [](const double value) { return std::isfinite(value); });
  }

  /// Passes a finite number on.
  /// @param what subject of the message: "the first residual"
  /// @throws ComputationError when it is not finite.
  double require_finite(const double value, const std::string &what);

  /// What is known to be no number where there is none (NaN or infinite), null in its place.
  nlohmann::ordered_json number_or_null(const double value);
  nlohmann::ordered_json numbers_or_null(const std::vector<double> &values);

  /// Paths ("/energy/strain") of the numbers of a JSON tree that are not finite.
  std::vector<std::string> non_finite_paths(const nlohmann::ordered_json &tree);
} // namespace perideal

#endif
