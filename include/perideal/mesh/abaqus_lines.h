// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_abaqus_lines_h
#define perideal_mesh_abaqus_lines_h

#include <cstdint>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace perideal
{
  /// The text in capital letters, in which Abaqus compares names.
  std::string in_capitals(std::string text);

  /// Reads an Abaqus input file keyword by keyword: a keyword with its options, "*ELSET, ELSET=top,
  /// GENERATE", and the data lines behind it.
  class AbaqusLines
  {
  public:
    using Words = std::vector<std::string>;

    /// Goes to the first keyword.
    /// @param filename for messages
    /// @throws InputError where something else stands there
    AbaqusLines(const std::string &text, const std::string &filename);

    /// Reads the keyword in the present line; false at the end of the file. Its data lines are next.
    bool next_keyword();

    /// In capitals, without the star.
    const std::string &keyword() const { return name; }

    /// Value of an option of the keyword, empty where it has none or is not given.
    std::string option(const std::string &option_name) const;
    bool        has_option(const std::string &option_name) const { return options.count(option_name) > 0; }

    /// Calls visit(words) with each data line up to the next keyword.
    template <typename Visit>
    void visit_data(const Visit &visit)
    {
      while (next_line() && line.front() != '*')
        visit(words_of(line));
    }

    /// Whether the present data line ends with a comma, and may go on in the next.
    bool goes_on() const { return line.back() == ','; }

    std::size_t line_number() const { return number_of_line; }

    /// A number of the file. @param what it counts, for messages @throws InputError where the word is none
    std::uint64_t number_of(const std::string &word, const std::string &what) const;

    /// A coordinate; 0 where the word is empty. @throws InputError where the word is no number
    double coordinate_of(const std::string &word) const;

    /// @throws InputError that names file and line
    [[noreturn]] void fail(const std::string &problem, const std::string &advice = "") const;

  private:
    bool  next_line();
    Words words_of(const std::string &text) const;

    std::istringstream                 stream;
    std::string                        filename, line;
    std::size_t                        number_of_line = 0;
    std::string                        name;
    std::map<std::string, std::string> options;
  };
} // namespace perideal

#endif
