// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/mesh/gmsh_lines.h>

namespace perideal
{
  bool GmshLines::next()
  {
    while (position < text.size())
      {
        const std::size_t end = std::min(text.find('\n', position), text.size());
        current               = std::string_view(text).substr(position, end - position);
        position              = end + 1;
        ++number;

        const std::size_t first = current.find_first_not_of(" \t\r");
        if (first != std::string_view::npos)
          {
            current = current.substr(first, current.find_last_not_of(" \t\r") - first + 1);
            return true;
          }
      }
    return false;
  }

  std::string_view GmshLines::entry(const std::string &section)
  {
    if (!next())
      fail_truncated(section);
    if (current.front() == '$')
      fail("the section $" + section + " holds fewer entries than it announces");
    return current;
  }

  void GmshLines::expect_end(const std::string &section)
  {
    if (!next())
      fail_truncated(section);
    if (current != "$End" + section)
      fail("expected the end of the section $" + section + ", which holds more than it announces");
  }

  void GmshLines::skip_section()
  {
    const std::string section(current.substr(1));
    while (next())
      if (current == "$End" + section)
        return;
    fail_truncated(section);
  }

  void GmshLines::fail(const std::string &problem, const std::string &advice) const
  {
    fail_at(number, problem, advice);
  }

  void GmshLines::fail_at(const std::size_t line, const std::string &problem, const std::string &advice) const
  {
    throw InputError(problem)
      .location(filename + ":" + std::to_string(line))
      .parameter("Mesh/File")
      .hint(advice);
  }

  void GmshLines::fail_at_entry(const std::string &section) const
  {
    fail("cannot read this entry of the section $" + section + ": '" + quoted() + "'");
  }

  std::string GmshLines::quoted() const
  {
    std::string text(current.substr(0, 60));
    for (char &letter : text)
      if (static_cast<unsigned char>(letter) < ' ' || letter == 127)
        letter = '?';
    return text;
  }

  void GmshLines::fail_truncated(const std::string &section) const
  {
    fail("the file is truncated: it ends inside the section $" + section, "save the mesh again");
  }
} // namespace perideal
