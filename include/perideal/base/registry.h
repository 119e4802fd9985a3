// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_registry_h
#define perideal_base_registry_h

#include <perideal/base/exceptions.h>

#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /// Returns the candidate with the smallest edit distance to @p given, or an empty
  /// string when none is close enough to be meant.
  std::string nearest_name(const std::string &given, const std::vector<std::string> &candidates);

  /// "a | b | c", the form in which lists of choices are shown.
  std::string join_choices(const std::vector<std::string> &names, const std::string &separator = " | ");

  /**
   * An ordered list of named choices. Each room with variants (models,
   * generators, influence functions, ...) writes its list once, in one place;
   * an unknown name is an error that lists the choices and the nearest.
   */
  template <typename Item>
  class Registry
  {
  public:
    /// @param parameter path of the parameter that names the choice, for messages.
    Registry(std::string parameter, std::vector<std::pair<std::string, Item>> items)
      : parameter(std::move(parameter))
      , items(std::move(items))
    {
    }

    auto begin() const { return items.begin(); }
    auto end() const { return items.end(); }

    std::vector<std::string> names() const
    {
      std::vector<std::string> result;
      for (const auto &item : items)
        result.push_back(item.first);
      return result;
    }

    /// @throws InputError when @p name is not in the list.
    const Item &get(const std::string &name) const
    {
      for (const auto &item : items)
        if (item.first == name)
          return item.second;
      throw InputError("unknown choice")
        .parameter(parameter)
        .given(name)
        .allowed(join_choices(names()))
        .nearest(nearest_name(name, names()));
    }

  private:
    std::string                               parameter;
    std::vector<std::pair<std::string, Item>> items;
  };
} // namespace perideal

#endif
