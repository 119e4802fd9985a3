// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/registry.h>
#include <perideal/parameters/declarations.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>

#include <array>
#include <cstdlib>
#include <regex>
#include <sstream>

namespace perideal
{
  Declarations declarations(const dealii::ParameterHandler &prm, const bool in_order)
  {
    using Handler = dealii::ParameterHandler;
    std::stringstream json;
    prm.print_parameters(json, in_order ? Handler::JSON | Handler::KeepDeclarationOrder : Handler::JSON);
    Declarations tree;
    boost::property_tree::read_json(json, tree);
    return tree;
  }

  bool is_parameter(const Declarations &entry)
  {
    return entry.find("pattern_description") != entry.not_found();
  }

  std::vector<std::string> declared_names(const Declarations &section, const bool parameters)
  {
    std::vector<std::string> result;
    for (const auto &child : section)
      if (is_parameter(child.second) == parameters)
        result.push_back(child.first);
    return result;
  }

  std::vector<std::string> selection_of(const std::string &pattern)
  {
    const std::string start = "[Selection ";
    if (pattern.rfind(start, 0) != 0)
      return {};
    return dealii::Utilities::split_string_list(
      pattern.substr(start.size(), pattern.rfind(']') - start.size()), '|');
  }

  std::string describe_pattern(const std::string &pattern)
  {
    const auto choices = selection_of(pattern);
    if (!choices.empty())
      return join_choices(choices);
    std::string text =
      dealii::Patterns::pattern_factory(pattern)->description(dealii::Patterns::PatternBase::Text);
    // deal.II's words for numbers without bounds
    const std::vector<std::array<std::string, 2>> words = {
      {{"A floating point number v such that -MAX_DOUBLE <= v <= MAX_DOUBLE", "a number"}},
      {{"A floating point number v such that ", "a number v, "}},
      {{" <= v <= MAX_DOUBLE", " <= v"}},
      {{"-MAX_DOUBLE <= v", "v"}},
      {{"An integer n such that ", "a whole number n, "}}};
    for (const auto &[theirs, ours] : words)
      for (std::size_t at; (at = text.find(theirs)) != std::string::npos;)
        text.replace(at, theirs.size(), ours);
    return text;
  }

  std::string decimal_comma(const std::string &value)
  {
    static const std::regex number("([-+]?[0-9]*),([0-9]+([eE][-+]?[0-9]+)?)");
    std::smatch             parts;
    if (!std::regex_match(value, parts, number))
      return "";
    return "numbers are written with a decimal point: " + parts.str(1) + "." + parts.str(2);
  }

  namespace
  {
    /// Whether two values are the same text, or the same number. Not by std::stod(), which throws at 1e-320.
    bool are_equal(const std::string &a, const std::string &b)
    {
      const dealii::Patterns::Double number;
      return a == b || (number.match(a) && number.match(b) &&
                        std::strtod(a.c_str(), nullptr) == std::strtod(b.c_str(), nullptr));
    }

    void list_changed(const Declarations                               &section,
                      const std::string                                &above,
                      std::vector<std::pair<std::string, std::string>> &result)
    {
      for (const auto &[name, entry] : section)
        if (!is_parameter(entry))
          list_changed(entry, above + name + "/", result);
        else if (!are_equal(entry.get<std::string>("value"), entry.get<std::string>("default_value")))
          result.emplace_back(above + name, entry.get<std::string>("default_value"));
    }
  } // namespace

  std::vector<std::pair<std::string, std::string>> changed_defaults(const dealii::ParameterHandler &prm)
  {
    std::vector<std::pair<std::string, std::string>> result;
    list_changed(declarations(prm, true), "", result);
    return result;
  }

  std::vector<std::string> changed_parameters(const dealii::ParameterHandler &prm)
  {
    std::vector<std::string> result;
    for (const auto &changed : changed_defaults(prm))
      result.push_back(changed.first);
    return result;
  }
} // namespace perideal
