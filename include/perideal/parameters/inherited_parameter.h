// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_inherited_parameter_h
#define perideal_parameters_inherited_parameter_h

#include <perideal/parameters/parameter_file.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>

namespace perideal
{
  /// Declares a parameter of a section "Above/Named" whose default is what the file gives to the parameter
  /// of the same name in "Above", where that is allowed. A section at the top has none above it.
  template <typename Value>
  void declare_inherited(dealii::ParameterHandler            &prm,
                         const ParameterFile                 &file,
                         const std::string                   &section,
                         const std::string                   &name,
                         Value                               &value,
                         const std::string                   &meaning,
                         const dealii::Patterns::PatternBase &pattern)
  {
    using Convert             = dealii::Patterns::Tools::Convert<Value>;
    std::string default_value = Convert::to_string(value, pattern);
    const auto  slash         = section.rfind('/');
    if (slash != std::string::npos)
      {
        const std::string inherited = file.value_of(section.substr(0, slash + 1) + name, "");
        if (pattern.match(inherited))
          default_value = inherited;
      }
    // Not add_parameter(), which would make the default anew from the value, with fewer digits.
    prm.declare_entry(name, default_value, pattern, meaning);
    const std::shared_ptr<const dealii::Patterns::PatternBase> kept = pattern.clone();
    prm.add_action(name, [&value, kept](const std::string &text) { value = Convert::to_value(text, *kept); });
  }
} // namespace perideal

#endif
