// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/crack_branching.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace perideal
{
  namespace
  {
    /// Largest gap in a band [spacings]; columns in a row that make a branching.
    constexpr double widest_gap = 3.5;
    constexpr int    n_columns  = 12;

    /// The bands of a column, and the middles of the outermost.
    struct Bands
    {
      unsigned int number = 0;
      double       lowest = 0, highest = 0;
    };

    Bands bands_of(std::vector<double> across, const double spacing)
    {
      std::sort(across.begin(), across.end());
      const auto is_gap = [&](const double a, const double b) { return b - a >= widest_gap * spacing; };
      const auto mean   = [](const auto begin, const auto end) {
        double sum = 0;
        for (auto x = begin; x != end; ++x)
          sum += *x;
        return sum / (end - begin);
      };
      const auto first_end  = std::adjacent_find(across.begin(), across.end(), is_gap);
      const auto last_begin = std::adjacent_find(
        across.rbegin(), across.rend(), [&](const double a, const double b) { return is_gap(b, a); });
      Bands result;
      result.number = 1;
      for (std::size_t k = 1; k < across.size(); ++k)
        result.number += is_gap(across[k - 1], across[k]);
      if (result.number == 1)
        return result;
      result.lowest  = mean(across.begin(), first_end + 1);
      result.highest = mean(across.rbegin(), last_begin + 1);
      return result;
    }

    using Columns = std::map<long, Bands>;

    /// The first of n_columns in a row with as many bands, or the end.
    Columns::const_iterator find_run(const Columns &columns, const unsigned int n_bands)
    {
      return std::find_if(columns.begin(), columns.end(), [&](const auto &column) {
        for (int k = 0; k < n_columns; ++k)
          {
            const auto other = columns.find(column.first + k);
            if (other == columns.end() || other->second.number < n_bands)
              return false;
          }
        return true;
      });
    }

    double slope(const std::vector<double> &x, const std::vector<double> &y)
    {
      const double n  = x.size();
      double       sx = 0, sy = 0, sxx = 0, sxy = 0;
      for (std::size_t k = 0; k < x.size(); ++k)
        {
          sx += x[k];
          sy += y[k];
          sxx += x[k] * x[k];
          sxy += x[k] * y[k];
        }
      return (n * sxy - sx * sy) / (n * sxx - sx * sx);
    }
  } // namespace

  std::optional<Branching>
  find_branching(const std::vector<std::array<double, 2>> &nodes, const double spacing, const double length)
  {
    using dealii::numbers::PI;
    // Nodes of a regular mesh lie in the middles of columns, wherever the origin is.
    double sine = 0, cosine = 0;
    for (const auto &node : nodes)
      {
        sine += std::sin(2 * PI * node[0] / spacing);
        cosine += std::cos(2 * PI * node[0] / spacing);
      }
    const double phase = std::atan2(sine, cosine) / (2 * PI);

    std::map<long, std::vector<double>> columns;
    for (const auto &node : nodes)
      if (node[0] > 0)
        columns[std::lround(node[0] / spacing - phase)].push_back(node[1]);
    Columns bands;
    for (const auto &column : columns)
      bands[column.first] = bands_of(column.second, spacing);
    const auto begin = find_run(bands, 2);
    if (begin == bands.end())
      return {};
    unsigned int n_branches = 2;
    while (find_run(bands, n_branches + 1) != bands.end())
      ++n_branches;

    const auto          place = [&](const long column) { return (column + phase) * spacing; };
    const double        reach = place(begin->first);
    std::vector<double> along, lowest, highest;
    for (auto column = begin;
         column != bands.end() && place(column->first) <= reach + length + 1e-6 * spacing;
         ++column)
      {
        if (column->second.number < 2)
          continue;
        along.push_back(place(column->first));
        lowest.push_back(column->second.lowest);
        highest.push_back(column->second.highest);
      }
    return Branching{
      reach, (std::atan(slope(along, highest)) - std::atan(slope(along, lowest))) * 180. / PI, n_branches};
  }
} // namespace perideal
