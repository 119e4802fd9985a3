// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/parameters/table_calls.h>

#include <algorithm>
#include <cctype>
#include <regex>

namespace perideal
{
  std::vector<std::pair<std::string, std::size_t>> names_in(const std::string &expression)
  {
    static const std::regex number_or_name("([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?|([A-Za-z_]\\w*)");
    std::vector<std::pair<std::string, std::size_t>> names;
    for (std::sregex_iterator word(expression.begin(), expression.end(), number_or_name), end; word != end;
         ++word)
      if (const auto letter = static_cast<unsigned char>(word->str().front());
          std::isalpha(letter) != 0 || letter == '_')
        names.emplace_back(word->str(), word->position() + word->length());
    return names;
  }

  std::shared_ptr<const ScatteredField> field_named(const std::string &name, const Tables &tables)
  {
    const auto found = tables.find(name);
    return found == tables.end() ? nullptr : found->second.field();
  }

  namespace
  {
    /// The position of the parenthesis that closes the one at @p open, or npos.
    std::size_t closing_parenthesis(const std::string &expression, const std::size_t open)
    {
      int depth = 0;
      for (std::size_t i = open; i < expression.size(); ++i)
        {
          depth += expression[i] == '(' ? 1 : expression[i] == ')' ? -1 : 0;
          if (depth == 0)
            return i;
        }
      return std::string::npos;
    }

    /// Whether a formula names a coordinate, or a field.
    bool names_place(const std::string &expression, const Tables &tables)
    {
      const auto        names = names_in(expression);
      const std::string axes  = "xyz";
      return std::any_of(names.begin(), names.end(), [&](const auto &name) {
        return (name.first.size() == 1 && axes.find(name.first) != std::string::npos) ||
               field_named(name.first, tables) != nullptr;
      });
    }
  } // namespace

  std::string
  replace_table_calls(const std::string &expression, const Tables &tables, std::vector<TableCall> &calls)
  {
    std::string result;
    std::size_t done = 0;
    for (const auto &[name, end] : names_in(expression))
      {
        if (tables.count(name) == 0 || end - name.size() < done || field_named(name, tables) != nullptr)
          continue;
        const std::size_t open = expression.find_first_not_of(" \t", end);
        if (open == std::string::npos || expression[open] != '(')
          throw InputError("this formula is wrong: the table " + name + " stands in it without a time")
            .hint("write " + name + "(t)");
        const std::size_t close = closing_parenthesis(expression, open);
        if (close == std::string::npos)
          throw InputError("this formula is wrong: a parenthesis behind the table " + name +
                           " is not closed");
        calls.push_back(
          {name, expression.substr(open + 1, close - open - 1), "_table_" + std::to_string(calls.size())});
        if (names_place(calls.back().argument, tables))
          throw InputError("this formula is wrong: the table " + name +
                           " is a function of time, and stands in it with a place")
            .hint("between its parentheses t may stand, and no coordinate");
        result += expression.substr(done, end - name.size() - done) + calls.back().constant;
        done = close + 1;
      }
    return result + expression.substr(done);
  }
} // namespace perideal
