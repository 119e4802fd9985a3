// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_reference_h
#define perideal_application_reference_h

#include <string>
#include <vector>

namespace perideal
{
  /// What the reference says of one parameter.
  struct ReferenceEntry
  {
    /// What a parameter holds.
    enum class Kind
    {
      number,
      whole_number,
      boolean,
      choice,
      text,
      list
    };

    /// Path of its section, "Material" or "Boundary conditions/ANY NAME", empty at the top of the file.
    std::string section;
    std::string name;
    Kind        kind = Kind::text;
    /// The default as it stands in files; nothing where the scene must give the parameter.
    std::string default_value;
    bool        must_be_given = false;
    /// The default for readers: a value, what an empty one means, or "none".
    std::string default_in_words;
    /// "m", "Pa", ...; "-" for numbers without a unit and for all that is no number.
    std::string unit;
    /// Values that are allowed, in words: "number > 0", "whole number, at least 1", "a | b".
    std::string allowed;
    /// The names of a choice.
    std::vector<std::string> choices;
    std::string              meaning;

    /// "Section/Name".
    std::string path() const { return section.empty() ? name : section + "/" + name; }
  };

  /// What @p pattern, deal.II's description of a pattern, and the meaning say together of the allowed values
  /// and the default. A meaning has the unit in brackets, the range of a number where the pattern has none
  /// ("> 0", "0 < share < 1", "1.5 to 6 [-]"), and what an empty value means after "empty:".
  ReferenceEntry
  reference_entry(const std::string &pattern, const std::string &default_value, const std::string &meaning);

  /// Every parameter, in the order of sections and declarations. Sections that the user names appear once,
  /// as "ANY NAME" or "PHYSICAL GROUP".
  std::vector<ReferenceEntry> reference();

  /// Paths of the fifteen parameters that most scenes need, in the order of a scene.
  const std::vector<std::string> &first_parameters();
} // namespace perideal

#endif
