// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/equal_records.h>
#include <perideal/base/spread_bits.h>

namespace perideal
{
  namespace
  {
    /// Lines of the lattice on which values are looked up, in tolerances: the chance that two equal values
    /// lie on both sides of the middle between two lines is its inverse.
    constexpr double tolerances_per_line = 1 << 20;
  } // namespace

  bool EqualRecords::is_equal(const std::size_t number, const std::vector<Entry> &record) const
  {
    const std::size_t first = known[number],
                      end   = number + 1 < known.size() ? known[number + 1] : values.size();
    if (end - first != record.size())
      return false;
    for (std::size_t k = 0; k < record.size(); ++k)
      if (!(std::abs(values[first + k] - record[k].value) <= record[k].tolerance))
        return false;
    return true;
  }

  std::size_t EqualRecords::number_of(const std::vector<Entry> &record)
  {
    // Neighbours are mostly alike.
    if (last < known.size() && is_equal(last, record))
      return last;
    std::uint64_t key = record.size();
    for (const Entry &entry : record)
      key = spread_bits(key + static_cast<std::uint64_t>(static_cast<std::int64_t>(
                                std::floor(entry.value / (tolerances_per_line * entry.tolerance) + 0.5))));
    std::vector<std::size_t> &candidates = with_key[key];
    for (const std::size_t number : candidates)
      if (is_equal(number, record))
        {
          last = number;
          return number;
        }
    last = known.size();
    candidates.push_back(last);
    known.push_back(values.size());
    for (const Entry &entry : record)
      values.push_back(entry.value);
    places.push_back(none);
    return last;
  }

  std::size_t &EqualRecords::place_of(const std::vector<Entry> &record)
  {
    const std::size_t number = number_of(record);
    if (++n_seen >= 256 && 4 * known.size() > 3 * n_seen)
      {
        looks  = false;
        known  = {};
        values = {};
        with_key.clear();
      }
    return places[number];
  }
} // namespace perideal
