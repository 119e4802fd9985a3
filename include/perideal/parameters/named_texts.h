// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_named_texts_h
#define perideal_parameters_named_texts_h

#include <perideal/parameters/parameter_file.h>

#include <string>
#include <vector>

namespace perideal
{
  /// One entry for each subsection of a section whose subsections the user names, with that name. All at
  /// once: parameters are bound to the entries, which must not move afterwards.
  template <typename Text>
  std::vector<Text> named_texts(const ParameterFile &file, const std::string &section)
  {
    std::vector<Text> result;
    for (const std::string &name : file.subsections(section))
      {
        result.emplace_back();
        result.back().name = name;
      }
    return result;
  }
} // namespace perideal

#endif
