// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/command_line.h>
#include <perideal/application/compare.h>
#include <perideal/application/gate.h>
#include <perideal/application/new_scene.h>
#include <perideal/application/plot.h>
#include <perideal/application/process_scene.h>
#include <perideal/application/rules.h>
#include <perideal/application/sweep.h>
#include <perideal/base/versions.h>
#include <perideal/problem/scene_parameters.h>

#include <deal.II/base/mpi.h>

#include <csignal>
#include <iostream>
#include <sstream>

namespace
{
  using namespace perideal;

  std::string version_text()
  {
    std::string text;
    const auto  list = versions();
    for (const auto &item : list.items())
      text += item.key() + ' ' + item.value().get<std::string>() + '\n';
    return text;
  }

  void act(const CommandLine &command_line, const bool speaks)
  {
    std::ostringstream text;
    switch (command_line.action)
      {
      case CommandLine::Action::help:
        text << CommandLine::help();
        break;
      case CommandLine::Action::version:
        text << version_text();
        break;
      case CommandLine::Action::print_parameters:
        print_parameters(text, command_line.format);
        break;
      case CommandLine::Action::new_scene:
        text << "scene       " << write_new_scene(command_line.scene_file, MPI_COMM_WORLD) << '\n';
        break;
      case CommandLine::Action::print_rules:
        print_rules(text);
        break;
      case CommandLine::Action::plot:
        text << "pictures    " << plot_run(command_line.directories[0], command_line.overrides) << '\n';
        break;
      case CommandLine::Action::sweep:
        run_sweep(command_line);
        break;
      case CommandLine::Action::compare:
        text << compare_runs(command_line.directories[0], command_line.directories[1]);
        break;
      default:
        process_scene(command_line);
      }
    if (speaks)
      std::cout << text.str() << std::flush;
  }
} // namespace

int main(int argc, char **argv)
{
  // A file that would grow beyond its limit cannot be written, like one on a full disk; it does not end the
  // program.
  std::signal(SIGXFSZ, SIG_IGN);
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  return run_guarded([&]() {
    act(CommandLine::parse(argc, argv), dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0);
  });
}
