// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_gmsh_lines_h
#define perideal_mesh_gmsh_lines_h

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

namespace perideal
{
  /// The numbers of one line, one after the other.
  class GmshFields
  {
  public:
    explicit GmshFields(const std::string_view line)
      : rest(line)
    {
    }

    /// False where the next word is not a number of this type.
    template <typename Number>
    bool read(Number &value)
    {
      skip_blanks();
      const auto result = std::from_chars(rest.data(), rest.data() + rest.size(), value);
      if (result.ec != std::errc())
        return false;
      rest.remove_prefix(result.ptr - rest.data());
      return rest.empty() || rest.front() == ' ' || rest.front() == '\t';
    }

    bool at_end()
    {
      skip_blanks();
      return rest.empty();
    }

  private:
    void skip_blanks() { rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size())); }

    std::string_view rest;
  };

  /// Walks through the lines of a `.msh` file; errors name file and line.
  class GmshLines
  {
  public:
    /// The arguments must outlive the object.
    GmshLines(const std::string &text, const std::string &filename)
      : text(text)
      , filename(filename)
    {
    }

    /// Advances to the next line that is not blank; false at the end of the text.
    bool next();

    /// The line, without blanks at its ends.
    std::string_view line() const { return current; }

    std::size_t line_number() const { return number; }

    /// The beginning of the line for messages, without control characters.
    std::string quoted() const;

    /// The next line, which must be an entry of the section.
    std::string_view entry(const std::string &section);

    /// Reads the next entry's first words as numbers.
    template <typename... Numbers>
    void read(const std::string &section, Numbers &...values)
    {
      GmshFields fields(entry(section));
      if (!(fields.read(values) && ...))
        fail_at_entry(section);
    }

    /// Reads the next entry, which must consist of these numbers.
    template <typename... Numbers>
    void read_all(const std::string &section, Numbers &...values)
    {
      GmshFields fields(entry(section));
      if (!(fields.read(values) && ...) || !fields.at_end())
        fail_at_entry(section);
    }

    /// The next line must be the end of the section.
    void expect_end(const std::string &section);

    /// Passes over the rest of a section whose beginning is the current line.
    void skip_section();

    /// @throws InputError with file, line and advice.
    [[noreturn]] void fail(const std::string &problem, const std::string &advice = "") const;

    /// @throws InputError about another line than the present one.
    [[noreturn]] void
    fail_at(const std::size_t line, const std::string &problem, const std::string &advice) const;

    /// @throws InputError about an entry that is not understood.
    [[noreturn]] void fail_at_entry(const std::string &section) const;

  private:
    [[noreturn]] void fail_truncated(const std::string &section) const;

    const std::string &text;
    const std::string &filename;
    std::size_t        position = 0;
    std::size_t        number   = 0;
    std::string_view   current;
  };
} // namespace perideal

#endif
