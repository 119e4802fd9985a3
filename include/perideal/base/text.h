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

  /// A text as it stands in a cell of a markdown table.
  inline std::string markdown_cell(std::string text)
  {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
      text.insert(at, "\\");
    return text;
  }
} // namespace perideal

#endif
