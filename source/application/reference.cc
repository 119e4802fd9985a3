// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/reference.h>
#include <perideal/base/registry.h>
#include <perideal/parameters/declarations.h>
#include <perideal/problem/scene_parameters.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

namespace perideal
{
  namespace
  {
    using Kind = ReferenceEntry::Kind;

    constexpr double endless = std::numeric_limits<double>::infinity();

    /// The groups of the first place in a text that fits, empty where none does.
    std::vector<std::string> groups_of(const std::string &text, const char *expression)
    {
      std::smatch match;
      if (!std::regex_search(text, match, std::regex(expression)))
        return {};
      return {match.begin() + 1, match.end()};
    }

    bool has(const std::string &text, const char *words)
    {
      return text.find(words) != std::string::npos;
    }

    /// A number in as few digits as tell it.
    std::string short_number(const double value)
    {
      std::ostringstream text;
      text.precision(6);
      text << value;
      return text.str();
    }

    /// "at least 1", "1 to 15", nothing where there are no bounds.
    std::string bounds_in_words(const double lower, const double upper)
    {
      if (lower > -endless && upper < endless)
        return short_number(lower) + " to " + short_number(upper);
      if (lower > -endless)
        return "at least " + short_number(lower);
      return upper < endless ? "at most " + short_number(upper) : "";
    }

    /// The range of a number that the meaning tells, nothing where it tells none.
    std::string range_in_meaning(const std::string &meaning)
    {
      const char *number = "(-?[0-9][-0-9.e]*)";
      const auto  both =
        groups_of(meaning, (std::string(number) + " (<=?) [A-Za-z_ ]+ (<=?) " + number).c_str());
      if (!both.empty())
        return (both[1].size() == 1 ? "> " : "at least ") + both[0] +
               (both[2].size() == 1 ? " and < " : " and at most ") + both[3];
      const auto span = groups_of(meaning, "([0-9][0-9.]*) to ([0-9][0-9.]*) \\[");
      if (!span.empty())
        return span[0] + " to " + span[1];
      const auto above = groups_of(meaning, "(?:^|[ ,])(>=?|above) ([-0-9.e]*[0-9]|f_t)");
      if (above.empty())
        return "";
      return (above[0].back() == '=' ? "at least " : "> ") + above[1];
    }

    /// Numbers of a pattern such as "[Double 0...MAX_DOUBLE (inclusive)]", in words.
    std::string numbers_in_words(const std::string &pattern, const std::string &meaning)
    {
      std::string words = range_in_meaning(meaning);
      if (!words.empty())
        return words;
      const auto bounds = groups_of(pattern, "(-?[0-9A-Z_.e+-]+)\\.\\.\\.(-?[0-9A-Z_.e+-]+) \\(inclusive\\)");
      if (bounds.empty())
        return "";
      // MAX_DOUBLE is no number for strtod, and the largest integers bound nothing.
      const auto bound = [](const std::string &text, const double none) {
        char        *end   = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        return *end != 0 || std::abs(value) >= std::numeric_limits<int>::max() ? none : value;
      };
      return bounds_in_words(bound(bounds[0], -endless), bound(bounds[1], endless));
    }

    std::string with_kind(const std::string &kind, const std::string &range)
    {
      const bool is_sign = !range.empty() && (range[0] == '>' || range[0] == '<');
      return range.empty() ? kind : kind + (is_sign ? " " : ", ") + range;
    }

    /// Entries of "[List of <[Double ...]> of length 0...3 (inclusive)]".
    std::string list_in_words(const std::string &pattern, const std::string &meaning)
    {
      const auto  parts = groups_of(pattern, "List of <(\\[.*\\])> of length ([0-9]+)\\.\\.\\.([0-9]+)");
      const bool  whole = has(parts[0], "[Integer"), any = has(parts[0], "[Double");
      std::string what = whole ? "whole numbers" : any ? "numbers" : "names";
      if (parts[2].size() < 4)
        what = "up to " + parts[2] + " " + what;
      if (whole || any)
        what = with_kind(what, numbers_in_words(parts[0], meaning));
      return what + "; separated by commas";
    }

    /// What a text is, as the meaning tells.
    std::string text_in_words(const std::string &meaning)
    {
      const auto formula = groups_of(meaning, "a formula in ([a-z](?:, [a-z]\\b)*)");
      if (!formula.empty())
        return "formula in " + formula[0];
      for (const char *words : {"coordinates", "components", "names or ids"})
        if (has(meaning, words))
          return std::string(words) + ", separated by commas";
      return "text";
    }

    void read_pattern(const std::string &pattern, ReferenceEntry &entry)
    {
      const std::string &meaning = entry.meaning;
      entry.choices              = selection_of(pattern);
      if (!entry.choices.empty())
        {
          entry.kind    = Kind::choice;
          entry.allowed = join_choices(entry.choices);
        }
      else if (has(pattern, "[Map"))
        {
          entry.kind    = Kind::list;
          entry.allowed = "NAME: numbers; NAME: numbers; and so on";
        }
      else if (has(pattern, "[List"))
        {
          entry.kind    = Kind::list;
          entry.allowed = list_in_words(pattern, meaning);
        }
      else if (has(pattern, "[Bool"))
        {
          entry.kind    = Kind::boolean;
          entry.allowed = "true | false";
        }
      else if (has(pattern, "[Integer"))
        {
          entry.kind    = Kind::whole_number;
          entry.allowed = with_kind("whole number", numbers_in_words(pattern, ""));
        }
      else if (has(pattern, "[Double"))
        {
          entry.kind    = Kind::number;
          entry.allowed = with_kind("number", numbers_in_words(pattern, meaning));
          if (!groups_of(entry.allowed, "(> 0)$").empty() && has(meaning, " 0: "))
            entry.allowed += ", or 0";
        }
      else
        entry.allowed = text_in_words(meaning);
    }

    /// All units in brackets, each once.
    std::string unit_in(const std::string &meaning)
    {
      std::vector<std::string> units;
      const std::regex         bracket("\\[([^\\]]+)\\]");
      for (std::sregex_iterator at(meaning.begin(), meaning.end(), bracket), end; at != end; ++at)
        if (std::find(units.begin(), units.end(), (*at)[1]) == units.end())
          units.push_back((*at)[1]);
      return units.empty() ? "-" : join_choices(units, " or ");
    }

    std::string default_in_words(const ReferenceEntry &entry)
    {
      if (entry.must_be_given)
        return "none";
      if (entry.default_value.empty())
        {
          const auto empty = groups_of(entry.meaning, "[Ee]mpty: ([^;.]*)");
          return !empty.empty() ? empty[0] : has(entry.meaning, "default ") ? "see the meaning" : "none";
        }
      if (entry.kind != Kind::number)
        return entry.default_value;
      const double value = std::strtod(entry.default_value.c_str(), nullptr);
      const bool   is_no_value =
        std::abs(value) > 1e300 || (value == 0 && entry.allowed == with_kind("number", "> 0"));
      return is_no_value ? "none" : short_number(value);
    }

    void
    list_entries(const Declarations &section, const std::string &path, std::vector<ReferenceEntry> &result)
    {
      for (const auto &[name, declared] : section)
        if (is_parameter(declared))
          {
            result.push_back(reference_entry(declared.get<std::string>("pattern_description"),
                                             declared.get<std::string>("default_value"),
                                             declared.get<std::string>("documentation")));
            result.back().section = path;
            result.back().name    = name;
          }
      for (const auto &[name, declared] : section)
        if (!is_parameter(declared))
          list_entries(declared, path.empty() ? name : path + "/" + name, result);
    }
  } // namespace

  ReferenceEntry
  reference_entry(const std::string &pattern, const std::string &default_value, const std::string &meaning)
  {
    ReferenceEntry entry;
    entry.meaning = meaning;
    read_pattern(pattern, entry);
    entry.must_be_given = has(meaning, "must give it");
    if (!entry.must_be_given)
      entry.default_value = default_value;
    const bool has_unit    = entry.kind != Kind::boolean && entry.kind != Kind::choice;
    entry.unit             = has_unit ? unit_in(meaning) : "-";
    entry.default_in_words = default_in_words(entry);
    return entry;
  }

  std::vector<ReferenceEntry> reference()
  {
    // Formulas call a table by its name.
    std::string text = "subsection Material\n subsection PHYSICAL GROUP\n end\nend\n"
                       "subsection Tables\n subsection ANY_NAME\n end\nend\n";
    for (const char *section : {"Boundary conditions",
                                "Point loads",
                                "Areal force densities",
                                "Gauges",
                                "Probes",
                                "Precracks",
                                "No-fail zones",
                                "Comparison",
                                "Cracks"})
      text += std::string("subsection ") + section + "\n subsection ANY NAME\n end\nend\n";
    SceneParameters          scene;
    dealii::ParameterHandler prm;
    scene.declare(prm, ParameterFile::parse(text, ""));
    std::vector<ReferenceEntry> result;
    list_entries(declarations(prm, true), "", result);
    return result;
  }

  const std::vector<std::string> &first_parameters()
  {
    static const std::vector<std::string> paths = {"Dimension",
                                                   "Mesh/File",
                                                   "Mesh/Scale",
                                                   "Mesh/Thickness",
                                                   "Material/Young modulus",
                                                   "Material/Poisson ratio",
                                                   "Material/Density",
                                                   "Material/Fracture energy",
                                                   "Boundary conditions/ANY NAME/Boundary",
                                                   "Boundary conditions/ANY NAME/u_x",
                                                   "Boundary conditions/ANY NAME/t_x",
                                                   "Solver/Name",
                                                   "Solver/Load steps",
                                                   "Solver/End time",
                                                   "Output/Fields"};
    return paths;
  }
} // namespace perideal
