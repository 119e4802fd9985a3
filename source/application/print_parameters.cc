// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/reference.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/text.h>
#include <perideal/problem/scene_parameters.h>

#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <ostream>

namespace perideal
{
  namespace
  {
    const char *const columns = "| parameter | default | unit | allowed | meaning |\n|---|---|---|---|---|\n";

    void print_row(std::ostream &out, const ReferenceEntry &entry, const std::string &name)
    {
      out << "| `" << name << "` | " << markdown_cell(entry.default_in_words) << " | " << entry.unit << " | "
          << markdown_cell(entry.allowed) << " | " << markdown_cell(entry.meaning) << " |\n";
    }

    const ReferenceEntry &entry_of(const std::vector<ReferenceEntry> &entries, const std::string &path)
    {
      return *std::find_if(
        entries.begin(), entries.end(), [&](const auto &entry) { return entry.path() == path; });
    }

    /// One table row a parameter, one heading a section, the first parameters of a beginner before all.
    void print_markdown(std::ostream &out, const std::vector<ReferenceEntry> &entries)
    {
      out << "# Parameters\n\nUnits stand in their column, \"-\" where there is none. A default of \"none\" "
             "is none: the scene must give the\nvalue, or goes without.\n\n"
             "## The fifteen that most scenes need\n\nIn the order of a scene.\n\n"
          << columns;
      for (const std::string &path : first_parameters())
        print_row(out, entry_of(entries, path), path);
      const std::string *section = nullptr;
      for (const ReferenceEntry &entry : entries)
        {
          if (section == nullptr || *section != entry.section)
            out << "\n## " << (entry.section.empty() ? "Top of the file" : entry.section) << "\n\n"
                << columns;
          section = &entry.section;
          print_row(out, entry, entry.name);
        }
      out << '\n';
    }

    void print_text(std::ostream &out, const std::vector<ReferenceEntry> &entries)
    {
      for (const ReferenceEntry &entry : entries)
        {
          out << entry.path() << "\n    default: " << entry.default_in_words
              << (entry.unit == "-" ? "" : ", unit: " + entry.unit) << ", allowed: " << entry.allowed << '\n';
          for (const std::string &line : dealii::Utilities::break_text_into_lines(entry.meaning, 100))
            out << "    " << line << '\n';
        }
    }

    /// A file to start from: everything with its default, what has none as a comment.
    void print_prm(std::ostream &out, const std::vector<ReferenceEntry> &entries)
    {
      std::vector<std::string> open;
      const auto               indent = [&] { return std::string(2 * open.size(), ' '); };
      for (const ReferenceEntry &entry : entries)
        {
          const auto  sections = entry.section.empty() ?
                                   std::vector<std::string>() :
                                   dealii::Utilities::split_string_list(entry.section, '/');
          std::size_t common   = 0;
          while (common < std::min(open.size(), sections.size()) && open[common] == sections[common])
            ++common;
          while (open.size() > common)
            {
              open.pop_back();
              out << indent() << "end\n";
            }
          for (; open.size() < sections.size(); open.push_back(sections[open.size()]))
            out << '\n' << indent() << "subsection " << sections[open.size()] << '\n';
          out << '\n';
          for (const std::string &line :
               dealii::Utilities::break_text_into_lines(entry.meaning, 100 - 2 * open.size()))
            out << indent() << "# " << line << '\n';
          out << indent() << "# Allowed: " << entry.allowed
              << (entry.unit == "-" ? "" : "; unit: " + entry.unit) << '\n'
              << indent() << (entry.must_be_given ? "# set " : "set ") << entry.name << " = "
              << (entry.kind == ReferenceEntry::Kind::number && !entry.must_be_given ?
                    (entry.default_in_words == "none" ? entry.default_value : entry.default_in_words) :
                    entry.default_value)
              << '\n';
        }
      for (; !open.empty(); out << indent() << "end\n")
        open.pop_back();
    }

    void print_json(std::ostream &out, const std::vector<ReferenceEntry> &entries)
    {
      static const char *const kinds[] = {"number", "whole number", "boolean", "choice", "text", "list"};
      auto                     list    = nlohmann::ordered_json::array();
      for (const ReferenceEntry &entry : entries)
        {
          const auto &first = first_parameters();
          list.push_back({{"path", entry.path()},
                          {"kind", kinds[static_cast<int>(entry.kind)]},
                          {"default",
                           entry.must_be_given ? nlohmann::ordered_json(nullptr) :
                                                 nlohmann::ordered_json(entry.default_value)},
                          {"default in words", entry.default_in_words},
                          {"unit", entry.unit},
                          {"allowed", entry.allowed},
                          {"choices", entry.choices},
                          {"first", std::find(first.begin(), first.end(), entry.path()) != first.end()},
                          {"meaning", entry.meaning}});
        }
      out << list.dump(1) << '\n';
    }
  } // namespace

  void print_parameters(std::ostream &out, const std::string &format)
  {
    if (format == "text")
      print_text(out, reference());
    else if (format == "prm")
      print_prm(out, reference());
    else if (format == "markdown")
      print_markdown(out, reference());
    else if (format == "json")
      print_json(out, reference());
    else
      throw InputError("unknown format of --parameters")
        .given(format)
        .allowed("text | prm | markdown | json");
  }
} // namespace perideal
