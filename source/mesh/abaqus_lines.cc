// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/mesh/abaqus_lines.h>
#include <perideal/mesh/gmsh_lines.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// As in the files of Gmsh that deal.II reads.
    constexpr std::uint64_t largest_abaqus_number = std::numeric_limits<int>::max();
  } // namespace

  std::string in_capitals(std::string text)
  {
    std::transform(
      text.begin(), text.end(), text.begin(), [](const unsigned char c) { return std::toupper(c); });
    return text;
  }

  AbaqusLines::AbaqusLines(const std::string &text, const std::string &filename)
    : stream(text)
    , filename(filename)
  {
    if (!next_line())
      fail("the mesh file is empty");
    if (line.front() != '*')
      fail("expected a keyword, such as *NODE", "the file must be an input file for Abaqus");
  }

  void AbaqusLines::fail(const std::string &problem, const std::string &advice) const
  {
    throw InputError(problem)
      .location(filename + ":" + std::to_string(number_of_line))
      .parameter("Mesh/File")
      .hint(advice);
  }

  /// Goes to the next line that is no comment and not empty.
  bool AbaqusLines::next_line()
  {
    while (std::getline(stream, line))
      {
        ++number_of_line;
        line = dealii::Utilities::trim(line);
        if (!line.empty() && line.rfind("**", 0) != 0)
          return true;
      }
    line.clear();
    return false;
  }

  AbaqusLines::Words AbaqusLines::words_of(const std::string &text) const
  {
    Words              words;
    std::istringstream parts(text);
    for (std::string word; std::getline(parts, word, ',');)
      words.push_back(dealii::Utilities::trim(word));
    if (words.empty())
      words.emplace_back();
    return words;
  }

  bool AbaqusLines::next_keyword()
  {
    if (line.empty())
      return false;
    std::string text = line.substr(1);
    while (!text.empty() && text.back() == ',' && next_line())
      text += line;
    const Words words = words_of(text);
    name              = in_capitals(words.front());
    options.clear();
    for (std::size_t k = 1; k < words.size(); ++k)
      {
        const std::size_t equals = std::min(words[k].find('='), words[k].size());
        std::string       value  = equals < words[k].size() ? words[k].substr(equals + 1) : "";
        value.erase(std::remove(value.begin(), value.end(), '"'), value.end());
        options[in_capitals(dealii::Utilities::trim(words[k].substr(0, equals)))] =
          dealii::Utilities::trim(value);
      }
    return true;
  }

  std::string AbaqusLines::option(const std::string &option_name) const
  {
    const auto found = options.find(option_name);
    return found == options.end() ? "" : found->second;
  }

  std::uint64_t AbaqusLines::number_of(const std::string &word, const std::string &what) const
  {
    GmshFields    fields(word);
    std::uint64_t number = 0;
    if (!fields.read(number) || !fields.at_end() || number > largest_abaqus_number)
      fail("'" + word + "' is no number of " + what);
    return number;
  }

  double AbaqusLines::coordinate_of(const std::string &word) const
  {
    // Abaqus writes a plus sign where it likes, and leaves out what is zero.
    const std::string text = word.empty() ? "0" : word.front() == '+' ? word.substr(1) : word;
    GmshFields        fields(text);
    double            x = 0;
    if (!fields.read(x) || !fields.at_end() || !std::isfinite(x))
      fail("'" + word + "' is no coordinate");
    return x;
  }
} // namespace perideal
