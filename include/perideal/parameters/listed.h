// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_listed_h
#define perideal_parameters_listed_h

#include <perideal/base/registry.h>

#include <deal.II/base/patterns.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * One of a list of things that say of themselves what they are: a model, a law, a criterion. Where an
   * enumeration would need a switch for each, a list has one line each.
   *
   * @tparam Traits what each says, with its name
   */
  template <typename Traits>
  class Listed
  {
  public:
    /// @throws InputError on a name that is not in the list.
    Listed(const std::string &name)
      : traits(&list().get(name))
    {
    }
    Listed(const char *name)
      : Listed(std::string(name))
    {
    }

    const Traits *operator->() const { return traits; }
    const Traits &operator*() const { return *traits; }

    /// All there are; stands in the file that holds the list.
    static const Registry<Traits> &list();

  private:
    const Traits *traits;
  };

  /// A list of things by their names.
  /// @param parameter path of the parameter that names one of them
  template <typename Traits>
  Registry<Traits> list_by_name(const std::string &parameter, const std::vector<Traits> &all)
  {
    std::vector<std::pair<std::string, Traits>> items;
    for (const Traits &traits : all)
      items.emplace_back(traits.name, traits);
    return {parameter, items};
  }

  template <typename Traits>
  std::string name_of(const Listed<Traits> &choice)
  {
    return choice->name;
  }

  /// "NAME: MEANING; NAME: MEANING" of all that have a meaning.
  template <typename Traits>
  std::string meanings_of()
  {
    std::vector<std::string> texts;
    for (const auto &[name, traits] : Listed<Traits>::list())
      texts.push_back(traits.meaning.empty() ? name : name + ": " + traits.meaning);
    return join_choices(texts, "; ");
  }
} // namespace perideal

/// @cond
/// Reads and writes choices from a list.
template <typename Traits>
struct dealii::Patterns::Tools::Convert<perideal::Listed<Traits>>
{
  static std::unique_ptr<PatternBase> to_pattern()
  {
    return std::make_unique<Selection>(perideal::join_choices(perideal::Listed<Traits>::list().names(), "|"));
  }

  static std::string to_string(const perideal::Listed<Traits> &value, const PatternBase & = Anything())
  {
    return perideal::name_of(value);
  }

  static perideal::Listed<Traits> to_value(const std::string &text, const PatternBase & = Anything())
  {
    return perideal::Listed<Traits>(text);
  }
};
/// @endcond

#endif
