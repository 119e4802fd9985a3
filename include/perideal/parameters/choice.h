// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_choice_h
#define perideal_parameters_choice_h

#include <deal.II/base/patterns.h>

#include <iterator>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

namespace perideal
{
  /**
   * The names that the values of an enumeration have in parameter files, in the order of the values.
   * An enumeration becomes a choice of the user by its names beside it:
   * @code
   * enum class Law { linear_elastic, neo_hookean };
   * template <>
   * struct ChoiceNames<Law> { static constexpr const char *list[] = {"linear elastic", "neo-Hookean"}; };
   * @endcode
   * dealii::ParameterHandler::add_parameter() then declares and reads it without a pattern. Names of the
   * past stand in parameter_file.cc.
   */
  template <typename Enum>
  struct ChoiceNames;

  /// Name of a value in parameter files and messages.
  template <typename Enum>
  std::string name_of(const Enum value)
  {
    Assert(static_cast<std::size_t>(value) < std::size(ChoiceNames<Enum>::list), dealii::ExcInternalError());
    return ChoiceNames<Enum>::list[static_cast<std::size_t>(value)];
  }

  /// Names of all values.
  template <typename Enum>
  std::vector<std::string> names_of()
  {
    return {std::begin(ChoiceNames<Enum>::list), std::end(ChoiceNames<Enum>::list)};
  }

  /// The value of a name.
  /// @throws ExcMessage on a text that is no name of a value.
  template <typename Enum>
  Enum choice_of(const std::string &name)
  {
    const auto  names = names_of<Enum>();
    std::size_t at    = 0;
    while (at < names.size() && names[at] != name)
      ++at;
    AssertThrow(at < names.size(), dealii::ExcMessage("\"" + name + "\" names no value of this enumeration"));
    return static_cast<Enum>(at);
  }
} // namespace perideal

/// @cond
/// Reads and writes enumerations with names.
template <typename Enum>
struct dealii::Patterns::Tools::Convert<Enum, std::void_t<decltype(perideal::ChoiceNames<Enum>::list)>>
{
  static std::unique_ptr<PatternBase> to_pattern()
  {
    std::string text;
    for (const std::string &name : perideal::names_of<Enum>())
      text += (text.empty() ? "" : "|") + name;
    return std::make_unique<Selection>(text);
  }

  static std::string to_string(const Enum &value, const PatternBase & = Anything())
  {
    return perideal::name_of(value);
  }

  static Enum to_value(const std::string &text, const PatternBase & = Anything())
  {
    return perideal::choice_of<Enum>(text);
  }
};
/// @endcond

#endif
