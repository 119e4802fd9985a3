// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/registry.h>
#include <perideal/parameters/declarations.h>
#include <perideal/parameters/parameter_file.h>

#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace perideal
{
  namespace
  {
    std::string join(const std::vector<std::string> &parts)
    {
      std::string text;
      for (const std::string &part : parts)
        text += (text.empty() ? "" : "/") + part;
      return text;
    }

    std::vector<std::string> split_path(const std::string &path)
    {
      return path.empty() ? std::vector<std::string>() : dealii::Utilities::split_string_list(path, '/');
    }

    /// Removes a comment and surrounding white space.
    std::string clean(const std::string &line)
    {
      return dealii::Utilities::trim(line.substr(0, line.find('#')));
    }

    /// Whether a line is text in UTF-8 without control characters, which files of results could hold.
    bool is_text(const std::string &line)
    {
      try
        {
          static_cast<void>(nlohmann::json(line).dump());
        }
      catch (const nlohmann::json::type_error &)
        {
          return false;
        }
      return std::all_of(
        line.begin(), line.end(), [](const unsigned char c) { return c >= ' ' || c == '\t'; });
    }

    /// The line with question marks for whatever is no plain character.
    std::string legible(std::string line)
    {
      std::replace_if(
        line.begin(), line.end(), [](const unsigned char c) { return c < ' ' || c >= 0x7f; }, '?');
      return line;
    }

    InputError no_text(const std::string &line)
    {
      return InputError("the line has bytes that are no text")
        .given(legible(line))
        .allowed("text in UTF-8 without control characters")
        .hint("type the line anew, or save the file in UTF-8");
    }

    /// True when @p line starts with @p keyword as a word; @p rest is what follows.
    bool starts_with(const std::string &line, const std::string &keyword, std::string &rest)
    {
      if (line.compare(0, keyword.size(), keyword) != 0)
        return false;
      if (line.size() > keyword.size() && line[keyword.size()] != ' ' && line[keyword.size()] != '\t')
        return false;
      rest = dealii::Utilities::trim(line.substr(keyword.size()));
      return true;
    }

    std::string title(const std::string &section)
    {
      return section.empty() ? "the top of the file" : "section \"" + section + "\"";
    }

    /// Where an assignment belongs: declarations of its section and parameter, as far as they are found.
    struct Place
    {
      const Declarations *section = nullptr, *parameter = nullptr;
      /// What was meant instead, where something is misspelt: a path, or "Section/".
      std::string meant;
    };

    /// @param errors gets what is misspelt, a section once
    /// @param unknown_sections that were met so far
    Place find_place(const Declarations              &all,
                     const ParameterFile::Assignment &assignment,
                     std::set<std::string>           &unknown_sections,
                     InputErrorCollector             &errors)
    {
      Place       place{&all, nullptr, ""};
      std::string above;
      for (const std::string &part : split_path(assignment.section))
        {
          const auto child = place.section->find(part);
          if (child == place.section->not_found() || is_parameter(child->second))
            {
              const auto        known = declared_names(*place.section, false);
              const std::string meant = nearest_name(part, known);
              place.meant             = meant.empty() ? "" : above + meant + "/";
              if (unknown_sections.insert(above + part).second)
                errors.add(InputError("unknown section in " +
                                      title(above.empty() ? above : above.substr(0, above.size() - 1)))
                             .location(assignment.origin)
                             .given("subsection " + part)
                             .allowed(join_choices(known))
                             .nearest(nearest_name(part, known)));
              return place;
            }
          place.section = &child->second;
          above += part + "/";
        }
      const auto entry = place.section->find(assignment.name);
      if (entry != place.section->not_found() && is_parameter(entry->second))
        {
          place.parameter = &entry->second;
          return place;
        }
      const auto        known = declared_names(*place.section, true);
      const std::string meant = nearest_name(assignment.name, known);
      place.meant             = meant.empty() ? "" : above + meant;
      errors.add(InputError("unknown parameter in " + title(assignment.section))
                   .location(assignment.origin)
                   .given(assignment.name)
                   .allowed(join_choices(known))
                   .nearest(nearest_name(assignment.name, known)));
      return place;
    }

    /// What a value is called now that had another name in the past.
    std::string present_value(const ParameterFile::Assignment &assignment)
    {
      static const std::map<std::array<std::string, 2>, std::string> past = {
        {{{"Boundary conditions/Treatment", "printed"}}, "published"},
        {{{"Boundary conditions/Traction treatment", "printed transfer"}}, "published transfer"},
        {{{"Boundary conditions/Traction treatment", "printed line to point"}}, "published line to point"}};
      const auto found = past.find({{assignment.path(), assignment.value}});
      return found == past.end() ? assignment.value : found->second;
    }

    /// Sets one value; false when it does not match the pattern.
    bool set_value(dealii::ParameterHandler &prm, const ParameterFile::Assignment &assignment)
    {
      const auto sections = split_path(assignment.section);
      for (const std::string &part : sections)
        prm.enter_subsection(part);
      bool matches = true;
      try
        {
          prm.set(assignment.name, present_value(assignment));
        }
      catch (const dealii::ExceptionBase &)
        {
          matches = false;
        }
      for (std::size_t k = 0; k < sections.size(); ++k)
        prm.leave_subsection();
      return matches;
    }
  } // namespace

  ParameterFile ParameterFile::read(const std::string &filename)
  {
    std::ifstream file(filename);
    if (!file)
      throw InputError("cannot read the parameter file")
        .location(filename)
        .hint("check the path; it is taken from the current directory");
    std::ostringstream text;
    text << file.rdbuf();
    return parse(text.str(), filename);
  }

  ParameterFile ParameterFile::parse(const std::string &text, const std::string &filename)
  {
    ParameterFile result;
    result.filename                       = filename;
    InputErrorCollector     &broken_lines = result.broken_lines;
    std::vector<std::string> section, opened_at;
    std::istringstream       lines(text);
    std::string              line, rest;
    for (unsigned int number = 1; std::getline(lines, line); ++number)
      {
        const std::string where = filename + ":" + std::to_string(number);
        line                    = clean(line);
        // A backslash at the end continues the line.
        for (std::string next; !line.empty() && line.back() == '\\' && std::getline(lines, next); ++number)
          line = dealii::Utilities::trim(line.substr(0, line.size() - 1)) + " " + clean(next);
        if (line.empty())
          continue;
        if (!is_text(line))
          {
            broken_lines.add(no_text(line).location(where));
            line = legible(line);
          }
        if (starts_with(line, "subsection", rest))
          {
            section.push_back(rest);
            opened_at.push_back(where);
            result.sections.push_back(join(section));
          }
        else if (line == "end")
          {
            if (section.empty())
              {
                broken_lines.add(InputError("\"end\" without a subsection").location(where));
                continue;
              }
            section.pop_back();
            opened_at.pop_back();
          }
        else if (starts_with(line, "set", rest))
          {
            const std::size_t equals = rest.find('=');
            if (equals == std::string::npos)
              {
                broken_lines.add(InputError("no \"=\" in this line")
                                   .location(where)
                                   .given(line)
                                   .allowed("set NAME = VALUE"));
                continue;
              }
            result.assignments.push_back({join(section),
                                          dealii::Utilities::trim(rest.substr(0, equals)),
                                          dealii::Utilities::trim(rest.substr(equals + 1)),
                                          where});
          }
        else
          broken_lines.add(InputError("line not understood")
                             .location(where)
                             .given(line)
                             .allowed("set NAME = VALUE | subsection NAME | end | # comment"));
      }
    if (!section.empty())
      broken_lines.add(InputError("subsection \"" + section.back() + "\" is never closed")
                         .location(opened_at.back())
                         .hint("add a line \"end\""));
    return result;
  }

  void ParameterFile::override_with(const std::string &text)
  {
    if (!is_text(text))
      throw no_text(text).location("--set");
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos)
      throw InputError("--set needs a parameter and a value")
        .given(text)
        .allowed("--set \"Section/Name=value\"");
    std::vector<std::string> path = split_path(dealii::Utilities::trim(text.substr(0, equals)));
    if (path.empty())
      throw InputError("--set without a parameter name").given(text).allowed("--set \"Section/Name=value\"");
    const std::string name = path.back();
    path.pop_back();
    const std::string section = join(path);
    if (!section.empty() && std::find(sections.begin(), sections.end(), section) == sections.end())
      sections.push_back(section);
    assignments.push_back({section, name, dealii::Utilities::trim(text.substr(equals + 1)), "--set " + text});
  }

  std::vector<std::string> ParameterFile::subsections(const std::string &section) const
  {
    std::vector<std::string> result;
    for (const std::string &candidate : sections)
      if (candidate.size() > section.size() + 1 &&
          candidate.compare(0, section.size() + 1, section + "/") == 0)
        {
          const std::string name = candidate.substr(section.size() + 1);
          if (name.find('/') == std::string::npos &&
              std::find(result.begin(), result.end(), name) == result.end())
            result.push_back(name);
        }
    return result;
  }

  std::string ParameterFile::value_of(const std::string &path, const std::string &default_value) const
  {
    std::string value = default_value;
    for (const Assignment &assignment : assignments)
      if (assignment.path() == path)
        value = assignment.value;
    return value;
  }

  std::vector<std::string> ParameterFile::apply(dealii::ParameterHandler &prm,
                                                InputErrorCollector      &errors) const
  {
    for (const InputError &error : broken_lines.list())
      errors.add(error);
    const Declarations       all = declarations(prm);
    std::set<std::string>    unknown_sections;
    std::vector<std::string> not_read;
    for (const Assignment &assignment : assignments)
      {
        const Place place = find_place(all, assignment, unknown_sections, errors);
        if (!place.parameter)
          {
            if (!place.meant.empty())
              not_read.push_back(place.meant);
          }
        else if (!set_value(prm, assignment))
          {
            const std::string allowed = place.parameter->get<std::string>("pattern_description");
            errors.add(InputError("this value is not allowed")
                         .location(assignment.origin)
                         .parameter(assignment.path())
                         .given(assignment.value)
                         .allowed(describe_pattern(allowed))
                         .nearest(nearest_name(assignment.value, selection_of(allowed)))
                         .hint(decimal_comma(assignment.value)));
            not_read.push_back(assignment.path());
          }
      }
    return not_read;
  }

  bool ParameterFile::gives(const std::string &path) const
  {
    return std::any_of(assignments.begin(), assignments.end(), [&](const Assignment &assignment) {
      return assignment.path() == path;
    });
  }

  InputError ParameterFile::locate(InputError error) const
  {
    if (error.parameter().empty())
      return error;
    const Assignment *last = nullptr;
    for (const Assignment &assignment : assignments)
      if (assignment.path() == error.parameter())
        last = &assignment;
    if (!error.has_location())
      error.location(last ? last->origin : filename);
    if (!error.has_given() && last)
      error.given(last->value);
    return error;
  }
} // namespace perideal
