// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_text_h
#define perideal_base_text_h

#include <cstdint>
#include <string>

namespace perideal
{
  /// Writes a count with separators: "12,345,678".
  inline std::string grouped(const std::uint64_t number)
  {
    std::string text = std::to_string(number);
    for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3)
      text.insert(at, ",");
    return text;
  }
} // namespace perideal

#endif
