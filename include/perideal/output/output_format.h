// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_output_format_h
#define perideal_output_output_format_h

#include <perideal/parameters/choice.h>

namespace perideal
{
  /// The files of a set of fields.
  enum class OutputFormat
  {
    /// One .vtu, with the cells of all ranks.
    vtu,
    /// A .vtu for the cells of each rank, and a .pvtu that lists them.
    pvtu
  };

  template <>
  struct ChoiceNames<OutputFormat>
  {
    static constexpr const char *list[] = {"vtu", "pvtu"};
  };
} // namespace perideal

#endif
