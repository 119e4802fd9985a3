// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/command_line.h>
#include <perideal/application/gate.h>
#include <perideal/application/new_scene.h>
#include <perideal/application/read_scene.h>
#include <perideal/application/rules.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/versions.h>
#include <perideal/drivers/driver.h>

#include <deal.II/base/mpi.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <sstream>

namespace
{
  using namespace perideal;

  template <int dim>
  void run_or_check(const SceneParameters &parameters, const RunContext &context, const bool only_check)
  {
    Problem<dim> problem(parameters, context, MPI_COMM_WORLD);
    const auto   driver = create_driver(problem);
    if (only_check)
      driver->check();
    else
      driver->run();
  }

  /// Reads the scene and runs it, with errors located in the file.
  void process(const CommandLine &command_line)
  {
    ParameterFile file = ParameterFile::read(command_line.scene_file);
    for (const std::string &text : command_line.overrides)
      file.override_with(text);
    try
      {
        dealii::ParameterHandler prm;
        SceneParameters          scene;
        read_scene(file, prm, scene);

        RunContext context;
        context.command         = command_line.command;
        context.scene_directory = std::filesystem::path(command_line.scene_file).parent_path().string();
        std::ostringstream json;
        prm.print_parameters(
          json, dealii::ParameterHandler::ShortJSON | dealii::ParameterHandler::KeepDeclarationOrder);
        context.parameters = nlohmann::ordered_json::parse(json.str());

        const bool only_check = command_line.action == CommandLine::Action::check;
        if (scene.dimension == 2)
          run_or_check<2>(scene, context, only_check);
        else
          run_or_check<3>(scene, context, only_check);
      }
    catch (const InputError &error)
      {
        throw file.locate(error);
      }
  }

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
      default:
        process(command_line);
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
