// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_tables_h
#define perideal_parameters_tables_h

#include <perideal/base/input_errors.h>
#include <perideal/parameters/choice.h>
#include <perideal/parameters/scattered_field.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  class ParameterFile;

  /// What a table is outside the times or points of its file.
  enum class OutsideTable
  {
    error,
    hold
  };

  template <>
  struct ChoiceNames<OutsideTable>
  {
    static constexpr const char *list[] = {"error", "hold"};
  };

  /// A function of time through given values, linear between them; or a field, a function of place.
  class Table
  {
  public:
    /// Zero at all times.
    Table() = default;

    /// @param times increasing [s], two or more @param values as many
    Table(std::vector<double> times, std::vector<double> values, const OutsideTable outside);

    /// Reads a text of comma-separated values: a line with the names of the columns, `time` and `value` among
    /// them in any order, then a line for each time; or of a field one or more of `x`, `y`, `z` and `value`,
    /// then a line for each point. Empty lines and those that begin with # do not count.
    /// @param filename for messages
    /// @throws InputError naming file and line where a column is missing, a value is no finite number, or
    ///   times do not increase, and where there are less than two times or points.
    static Table parse(const std::string &text, const std::string &filename, const OutsideTable outside);

    /// The value at a time [s], outside the times of the file the nearest one.
    double value(const double time) const;

    /// Whether the file says what the value at a time [s] is, but for rounding, or the scene.
    bool covers(const double time) const;

    /// "from 0 s to 2.5 s".
    std::string range() const;

    /// What it is where it is a function of place, null where it is one of time.
    std::shared_ptr<const ScatteredField> field() const { return of_place; }

  private:
    std::vector<double>                   times, values;
    OutsideTable                          outside = OutsideTable::hold;
    std::shared_ptr<const ScatteredField> of_place;
  };

  /// By the names that formulas have for them.
  using Tables = std::map<std::string, Table>;

  /// Subsection of "Tables", as text.
  struct TableText
  {
    std::string  name, file;
    OutsideTable outside = OutsideTable::error;
  };

  /// Section "Tables": functions of time or place for formulas, from files.
  struct TableParameters
  {
    std::vector<TableText> texts;
    /// Those that were read; one with a mistake is zero.
    Tables tables;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);

    /// Reads the files.
    /// @param directory of the scene, where they may lie
    /// @param mistakes gets names that formulas cannot have, files that are missing, and as Table::parse()
    void read(const std::string &directory, InputErrorCollector &mistakes);
  };
} // namespace perideal

#endif
