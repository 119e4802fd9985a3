// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/process_scene.h>
#include <perideal/application/read_scene.h>
#include <perideal/drivers/adaptive_run.h>
#include <perideal/drivers/driver.h>
#include <perideal/parameters/declarations.h>

#include <filesystem>
#include <sstream>

namespace perideal
{
  namespace
  {
    template <int dim>
    void run_or_check(const SceneParameters &parameters, const RunContext &context, const bool only_check)
    {
      if ((parameters.adaptation.is_by_error() || parameters.adaptation.is_by_need()) && !only_check)
        {
          run_adaptively<dim>(parameters, context, MPI_COMM_WORLD);
          return;
        }
      Problem<dim> problem(parameters, context, MPI_COMM_WORLD);
      const auto   driver = create_driver(problem);
      if (only_check)
        driver->check();
      else
        driver->run();
    }

    RunContext context_of(const CommandLine &command_line, const dealii::ParameterHandler &prm)
    {
      RunContext context;
      context.command         = command_line.command;
      context.scene_directory = std::filesystem::path(command_line.scene_file).parent_path().string();
      std::ostringstream json;
      prm.print_parameters(
        json, dealii::ParameterHandler::ShortJSON | dealii::ParameterHandler::KeepDeclarationOrder);
      context.parameters   = nlohmann::ordered_json::parse(json.str());
      context.changed_from = nlohmann::ordered_json::object();
      for (const auto &[path, value] : changed_defaults(prm))
        context.changed_from[path] = value;
      return context;
    }

    ParameterFile file_of(const CommandLine &command_line)
    {
      ParameterFile file = ParameterFile::read(command_line.scene_file);
      for (const std::string &text : command_line.overrides)
        file.override_with(text);
      return file;
    }
  } // namespace

  void process_scene(const CommandLine &command_line)
  {
    const ParameterFile file = file_of(command_line);
    try
      {
        dealii::ParameterHandler prm;
        SceneParameters          scene;
        read_scene(file, prm, scene);
        const RunContext context    = context_of(command_line, prm);
        const bool       only_check = command_line.action == CommandLine::Action::check;
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

  void check_parameters(const CommandLine &command_line)
  {
    const ParameterFile      file = file_of(command_line);
    dealii::ParameterHandler prm;
    SceneParameters          scene;
    read_scene(file, prm, scene);
  }

  std::string output_directory(const CommandLine &command_line)
  {
    return file_of(command_line).value_of("Output directory", SceneParameters().output_directory);
  }
} // namespace perideal
