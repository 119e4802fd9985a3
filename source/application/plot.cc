// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/plot.h>
#include <perideal/base/exceptions.h>
#include <perideal/output/pictures.h>
#include <perideal/parameters/parameter_file.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace perideal
{
  namespace
  {
    /// Gives the parameters the values of the run, as far as summary.json has them.
    void take_parameters_of_run(const std::string &directory, dealii::ParameterHandler &prm)
    {
      std::ifstream file(directory + "/summary.json");
      const auto    summary = nlohmann::json::parse(file, nullptr, false);
      const auto    path    = nlohmann::json::json_pointer("/parameters/Output");
      if (summary.is_discarded() || !summary.contains(path))
        return;
      const nlohmann::json &output = summary.at(path);
      prm.enter_subsection("Output");
      for (const char *name : {"Pictures", "View"})
        if (output.contains(name))
          prm.set(name, output.at(name).get<std::string>());
      prm.leave_subsection();
    }

    PictureParameters read_parameters(const std::string &directory, const std::vector<std::string> &overrides)
    {
      PictureParameters        parameters;
      dealii::ParameterHandler prm;
      parameters.declare(prm);
      take_parameters_of_run(directory, prm);
      ParameterFile file;
      for (const std::string &text : overrides)
        file.override_with(text);
      InputErrorCollector errors;
      file.apply(prm, errors);
      errors.collect([&] { parameters.check(); });
      errors.raise();
      parameters.report = true;
      return parameters;
    }
  } // namespace

  std::string plot_run(const std::string &directory, const std::vector<std::string> &overrides)
  {
    const std::filesystem::path path(directory);
    std::error_code             ignored;
    if (!std::filesystem::exists(path / "solution.pvd", ignored) &&
        !std::filesystem::exists(path / "summary.json", ignored))
      throw InputError("this directory holds no results of a run")
        .given(directory)
        .allowed("the output directory of a run, with solution.pvd and summary.json");
    const PictureParameters parameters = read_parameters(directory, overrides);
    ToolResult              result;
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      result = draw_pictures(directory, parameters);
    const auto problem = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, result.problem);
    if (dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, result.is_refused))
      throw InputError(problem).given(directory);
    if (!problem.empty())
      throw ComputationError("no pictures: " + problem);
    return result.in_one_line();
  }
} // namespace perideal
