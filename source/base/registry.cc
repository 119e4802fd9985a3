// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/registry.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace perideal
{
  namespace
  {
    /// Levenshtein distance, ignoring case.
    std::size_t edit_distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const bool same = std::tolower(static_cast<unsigned char>(a[i - 1])) ==
                                std::tolower(static_cast<unsigned char>(b[j - 1]));
              const std::size_t substituted = diagonal + (same ? 0 : 1);
              diagonal                      = row[j];
              row[j]                        = std::min({row[j] + 1, row[j - 1] + 1, substituted});
            }
        }
      return row.back();
    }
  } // namespace

  std::string nearest_name(const std::string &given, const std::vector<std::string> &candidates)
  {
    std::string best;
    std::size_t best_distance = std::max<std::size_t>(2, given.size() / 2) + 1;
    for (const std::string &candidate : candidates)
      {
        const std::size_t distance = edit_distance(given, candidate);
        if (distance < best_distance)
          {
            best_distance = distance;
            best          = candidate;
          }
      }
    return best;
  }

  std::string join_choices(const std::vector<std::string> &names, const std::string &separator)
  {
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? "" : separator) + name;
    return text;
  }
} // namespace perideal
