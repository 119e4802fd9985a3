// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/find_file.h>
#include <perideal/base/finite.h>
#include <perideal/base/registry.h>
#include <perideal/parameters/named_texts.h>
#include <perideal/parameters/space_time_function.h>
#include <perideal/parameters/tables.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

namespace perideal
{
  namespace
  {
    constexpr const char *columns_of_tables =
      "time [s] and value, of a field x, y or z [m] and value, named in the first line, separated by commas";

    /// A line of a text of comma-separated values, and where it stands.
    struct Line
    {
      std::string              at;
      std::vector<std::string> fields;
    };

    /// The lines that count.
    std::vector<Line> lines_of(const std::string &text, const std::string &filename)
    {
      std::istringstream stream(text);
      std::vector<Line>  lines;
      std::string        line;
      for (unsigned int number = 1; std::getline(stream, line); ++number)
        {
          // What spreadsheets begin files with.
          if (number == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0)
            line.erase(0, 3);
          line = dealii::Utilities::trim(line);
          if (!line.empty() && line.front() != '#')
            lines.push_back(
              {filename + ":" + std::to_string(number), dealii::Utilities::split_string_list(line, ',')});
        }
      return lines;
    }

    /// The number in a field of a line.
    double number_in(const Line &line, const std::size_t column)
    {
      if (column >= line.fields.size())
        throw InputError("a line of the table has too few values")
          .location(line.at)
          .allowed(columns_of_tables);
      const std::string &given  = line.fields[column];
      double             result = 0;
      try
        {
          result = dealii::Utilities::string_to_double(given);
        }
      catch (const dealii::ExceptionBase &)
        {
          throw InputError("a value of the table is not a number")
            .location(line.at)
            .given(given)
            .hint("numbers are written with a decimal point, such as 1.5e6");
        }
      if (!is_finite(result))
        throw InputError("a value of the table is not a finite number").location(line.at).given(given);
      return result;
    }

    bool has_column(const Line &names, const std::string &name)
    {
      return std::find(names.fields.begin(), names.fields.end(), name) != names.fields.end();
    }

    /// Where a column stands in the line of their names.
    std::size_t column_named(const std::string &name, const Line &names)
    {
      if (!has_column(names, name))
        throw InputError("the table has no column \"" + name + "\"")
          .location(names.at)
          .given(join_choices(names.fields, ","))
          .allowed(columns_of_tables);
      return std::find(names.fields.begin(), names.fields.end(), name) - names.fields.begin();
    }

    /// The field of the lines behind that of the names.
    std::shared_ptr<const ScatteredField> parse_field(const std::vector<Line> &lines, const bool holds)
    {
      const Line               &names    = lines.front();
      const std::size_t         of_value = column_named("value", names);
      std::vector<unsigned int> axes;
      for (unsigned int d = 0; d < 3; ++d)
        if (has_column(names, std::string(1, "xyz"[d])))
          axes.push_back(d);
      std::vector<dealii::Point<3>> points(lines.size() - 1);
      std::vector<double>           values;
      for (std::size_t k = 1; k < lines.size(); ++k)
        {
          for (const unsigned int d : axes)
            points[k - 1][d] = number_in(lines[k], column_named(std::string(1, "xyz"[d]), names));
          values.push_back(number_in(lines[k], of_value));
        }
      return std::make_shared<const ScatteredField>(std::move(points), std::move(values), axes, holds);
    }
  } // namespace

  Table::Table(std::vector<double> times, std::vector<double> values, const OutsideTable outside)
    : times(std::move(times))
    , values(std::move(values))
    , outside(outside)
  {
    AssertDimension(this->times.size(), this->values.size());
  }

  Table Table::parse(const std::string &text, const std::string &filename, const OutsideTable outside)
  {
    const std::vector<Line> lines = lines_of(text, filename);
    if (!lines.empty() && !has_column(lines.front(), "time") &&
        (has_column(lines.front(), "x") || has_column(lines.front(), "y") || has_column(lines.front(), "z")))
      {
        if (lines.size() < 3)
          throw InputError("the field has less than two points")
            .location(filename)
            .allowed(columns_of_tables);
        Table result;
        result.of_place = parse_field(lines, outside == OutsideTable::hold);
        return result;
      }
    const std::size_t   of_time  = lines.empty() ? 0 : column_named("time", lines.front());
    const std::size_t   of_value = lines.empty() ? 0 : column_named("value", lines.front());
    std::vector<double> times, values;
    for (std::size_t k = 1; k < lines.size(); ++k)
      {
        times.push_back(number_in(lines[k], of_time));
        values.push_back(number_in(lines[k], of_value));
        if (times.size() > 1 && !(times.back() > times[times.size() - 2]))
          throw InputError("the times of the table do not increase")
            .location(lines[k].at)
            .given(lines[k].fields[of_time])
            .allowed("a time later than that of the line before")
            .hint("sort the lines by time; a jump is two times close to each other");
      }
    if (times.size() < 2)
      throw InputError("the table has less than two times").location(filename).allowed(columns_of_tables);
    return Table(times, values, outside);
  }

  double Table::value(const double time) const
  {
    if (times.empty())
      return 0.;
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin())
      return values.front();
    if (after == times.end())
      return values.back();
    const std::size_t k     = after - times.begin();
    const double      share = (time - times[k - 1]) / (times[k] - times[k - 1]);
    return values[k - 1] + share * (values[k] - values[k - 1]);
  }

  bool Table::covers(const double time) const
  {
    if (outside == OutsideTable::hold)
      return true;
    const double rounding = 1e-9 * (times.back() - times.front());
    return time >= times.front() - rounding && time <= times.back() + rounding;
  }

  std::string Table::range() const
  {
    std::ostringstream text;
    if (!times.empty())
      text << "from " << times.front() << " s to " << times.back() << " s";
    return text.str();
  }

  void TableParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Tables");
    texts = named_texts<TableText>(file, "Tables");
    for (TableText &text : texts)
      {
        prm.enter_subsection(text.name);
        prm.add_parameter(
          "File",
          text.file,
          "File of comma-separated values, beside the scene or from the current directory: a line with the "
          "names of the columns, time [s] and value among them, then a line for each time. Formulas call the "
          "table by its name, such as 1e-3*ramp(t); between the times it is linear. With x, y or z [m] in "
          "the "
          "place of time it is a field, whose name stands in formulas alone, such as 20 + heat*t");
        prm.add_parameter("Outside",
                          text.outside,
                          "What the table is before its first time and after its last one, or a field away "
                          "from its points: error: the run stops; hold: the nearest value");
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  void TableParameters::read(const std::string &directory, InputErrorCollector &mistakes)
  {
    const std::vector<std::string> taken = names_in_formulas();
    for (const TableText &text : texts)
      {
        const std::string section = "Tables/" + text.name;
        Table            &table   = tables[text.name];
        if (!std::regex_match(text.name, std::regex("[A-Za-z]\\w*")) ||
            std::find(taken.begin(), taken.end(), text.name) != taken.end())
          mistakes.add(InputError("formulas cannot call a table by this name")
                         .parameter(section)
                         .allowed("a letter, then letters, digits and _, and no name that formulas know "
                                  "already, such as t or sin"));
        mistakes.collect([&] {
          if (text.file.empty())
            throw InputError("the table has no file").parameter(section).allowed("File = NAME.csv");
          try
            {
              const std::string  path = find_file(text.file, directory, "table", {".csv", ".txt"});
              std::ifstream      stream(path, std::ios::binary);
              std::ostringstream content;
              content << stream.rdbuf();
              table = Table::parse(content.str(), path, text.outside);
            }
          catch (InputError &error)
            {
              throw error.parameter(section + "/File");
            }
        });
      }
  }
} // namespace perideal
