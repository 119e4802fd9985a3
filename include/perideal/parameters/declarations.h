// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_declarations_h
#define perideal_parameters_declarations_h

#include <deal.II/base/parameter_handler.h>

#include <boost/property_tree/ptree.hpp>

#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /// Parameters and subsections of a section, as dealii::ParameterHandler keeps them: each parameter with its
  /// value, default, pattern and description.
  using Declarations = boost::property_tree::ptree;

  /// Everything declared, by name, or in the order of declaration.
  Declarations declarations(const dealii::ParameterHandler &prm, const bool in_order = false);

  /// Whether an entry is a parameter, and not a subsection.
  bool is_parameter(const Declarations &entry);

  /// Names of the parameters, or of the subsections, directly in a section.
  std::vector<std::string> declared_names(const Declarations &section, const bool parameters);

  /// The choices that a pattern description "[Selection a|b ]" lists, none for other patterns.
  std::vector<std::string> selection_of(const std::string &pattern);

  /// A pattern description in words.
  std::string describe_pattern(const std::string &pattern);

  /// Advice for a number such as "70,5e9", nothing for other texts.
  std::string decimal_comma(const std::string &value);

  /// Path and default of the parameters that have another value, in the order of declaration.
  std::vector<std::pair<std::string, std::string>> changed_defaults(const dealii::ParameterHandler &prm);

  /// Paths of the parameters that have another value than their default.
  std::vector<std::string> changed_parameters(const dealii::ParameterHandler &prm);
} // namespace perideal

#endif
