// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_parameter_file_h
#define perideal_parameters_parameter_file_h

#include <perideal/base/input_errors.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace perideal
{
  /**
   * The lines of a `.prm` file with `--set` overrides behind them, before any
   * of them is checked.
   *
   * dealii::ParameterHandler needs every subsection declared before it reads;
   * here the user names some (boundary conditions, materials). So the file is
   * first read as plain lines, the named subsections are declared from
   * subsections(), and apply() then sets and checks every value, with messages
   * that name file, line, parameter, given and allowed values. What is wrong is
   * kept until all lines have been looked at.
   */
  class ParameterFile
  {
  public:
    /// One `set name = value` line.
    struct Assignment
    {
      /// Enclosing subsections, joined by '/', empty at the top.
      std::string section;
      std::string name;
      std::string value;
      /// "file.prm:12", or "--set" for an override.
      std::string origin;

      /// "Section/Name".
      std::string path() const { return section.empty() ? name : section + "/" + name; }
    };

    ParameterFile() = default;

    /// @throws InputError when the file is missing; lines that are not understood are mistakes of apply().
    static ParameterFile read(const std::string &filename);

    /// As read(), from text; @p filename is used in messages only.
    static ParameterFile parse(const std::string &text, const std::string &filename);

    /// Appends "Section/Name=value", as given to `--set`.
    /// @throws InputError when the text has not this form.
    void override_with(const std::string &text);

    /// The directory in which the file lies, with a '/' behind it; empty where that is the current one.
    std::string directory() const { return filename.substr(0, filename.rfind('/') + 1); }

    /// Names of the subsections directly below @p section, in file order.
    std::vector<std::string> subsections(const std::string &section) const;

    /// The last value given to a parameter, or @p default_value.
    std::string value_of(const std::string &path, const std::string &default_value) const;

    /// Sets every value in @p prm that can be read; the others keep their defaults. Lines that are not
    /// understood, misspelt sections and names, and values that do not match their pattern, go to
    /// @p errors with the choices there are.
    /// @return paths of what was not read, as far as it can be guessed, "Section/" where that is a section
    std::vector<std::string> apply(dealii::ParameterHandler &prm, InputErrorCollector &errors) const;

    /// Whether the file or an override gives this parameter.
    bool gives(const std::string &path) const;

    /// Adds file, line and given value to an error that names only a parameter.
    InputError locate(InputError error) const;

  private:
    std::vector<Assignment>  assignments;
    std::vector<std::string> sections;
    std::string              filename;
    /// Lines that were not understood.
    InputErrorCollector broken_lines;
  };
} // namespace perideal

#endif
