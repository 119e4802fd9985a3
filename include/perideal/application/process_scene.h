// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_process_scene_h
#define perideal_application_process_scene_h

#include <perideal/application/command_line.h>

#include <string>

namespace perideal
{
  /// Reads the scene that the user typed, and runs it, or checks it only; errors are located in its file.
  /// Collective.
  /// @throws InputError, ComputationError, and Stopped where the program was asked to stop
  void process_scene(const CommandLine &command_line);

  /// Reads the scene, and nothing more. @throws InputError on all mistakes that its parameters show
  void check_parameters(const CommandLine &command_line);

  /// Where the scene would leave its results.
  /// @throws InputError where there is no such file
  std::string output_directory(const CommandLine &command_line);
} // namespace perideal

#endif
