// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_table_calls_h
#define perideal_parameters_table_calls_h

#include <perideal/parameters/tables.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /// The names in a formula, each with the position behind it.
  std::vector<std::pair<std::string, std::size_t>> names_in(const std::string &expression);

  /// The field of that name, null where there is none, or a table of times.
  std::shared_ptr<const ScatteredField> field_named(const std::string &name, const Tables &tables);

  /// A call of a table in a formula, such as ramp(2*t).
  struct TableCall
  {
    /// Of the table.
    std::string name;
    /// Between the parentheses.
    std::string argument;
    /// What stands in the place of the call.
    std::string constant;
  };

  /// Puts names of constants in the place of the outermost calls of tables of times.
  /// @param calls gets these calls
  /// @throws InputError where a table stands without parentheses, and where its argument names a coordinate.
  std::string
  replace_table_calls(const std::string &expression, const Tables &tables, std::vector<TableCall> &calls);
} // namespace perideal

#endif
