// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_command_line_h
#define perideal_application_command_line_h

#include <string>
#include <vector>

namespace perideal
{
  /// What the user typed.
  struct CommandLine
  {
    enum class Action
    {
      run,
      check,
      plot,
      sweep,
      compare,
      print_parameters,
      print_rules,
      new_scene,
      help,
      version
    };
    Action action = Action::run;
    /// Of Action::new_scene: the mesh file.
    std::string scene_file;
    /// Texts of --set.
    std::vector<std::string> overrides;
    /// Texts of --sweep.
    std::vector<std::string> sweeps;
    /// Output directories of runs that have ended: of --plot or --compare.
    std::vector<std::string> directories;
    /// Format of --parameters.
    std::string format = "text";
    /// The whole command, for summary.json.
    std::string command;

    /// @throws InputError on anything not understood.
    static CommandLine parse(const int argc, const char *const *argv);

    static std::string help();
  };
} // namespace perideal

#endif
