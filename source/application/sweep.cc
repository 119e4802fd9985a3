// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/process_scene.h>
#include <perideal/application/sweep.h>
#include <perideal/base/exceptions.h>
#include <perideal/base/python_tool.h>
#include <perideal/base/rendezvous.h>
#include <perideal/output/files.h>
#include <perideal/output/summary.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>

namespace perideal
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    Json summary_in(const std::string &directory)
    {
      std::ifstream file(directory + "/summary.json");
      Json          summary = Json::parse(file, nullptr, false);
      return summary.is_object() ? summary : Json::object();
    }

    /// A number of a summary by its path, not a number where it has none.
    double number_at(const Json &summary, const std::string &path)
    {
      const Json::json_pointer pointer(path);
      return summary.contains(pointer) && summary.at(pointer).is_number() ?
               summary.at(pointer).get<double>() :
               std::nan("");
    }

    std::string text_of_number(const double value)
    {
      return std::isfinite(value) ? short_number(value) : "";
    }

    /// What the solutions are compared with.
    std::vector<std::string> comparisons_of(const std::vector<SweptRun> &runs)
    {
      std::vector<std::string> names;
      for (const SweptRun &run : runs)
        if (run.summary.contains("errors"))
          for (const auto &entry : run.summary["errors"].items())
            if (entry.value().contains("l2") &&
                std::find(names.begin(), names.end(), entry.key()) == names.end())
              names.push_back(entry.key());
      return names;
    }

    /// How fast a figure falls from one run to the next.
    double order_between(const SweptRun &before, const SweptRun &run, const std::string &path)
    {
      unsigned int n_changed = 0;
      for (std::size_t k = 0; k < run.values.size(); ++k)
        n_changed += run.values[k] != before.values[k];
      const double ratio = number_at(run.summary, "/nodes") / number_at(before.summary, "/nodes");
      if (n_changed != 1 || !(std::abs(ratio - 1) > 1e-6))
        return std::nan("");
      return std::log(number_at(before.summary, path) / number_at(run.summary, path)) /
             (std::log(ratio) / number_at(run.summary, "/mesh/dim"));
    }

    std::vector<std::vector<std::string>> all_combinations(const std::vector<SweptParameter> &parameters)
    {
      std::vector<std::vector<std::string>> result = {{}};
      for (const SweptParameter &parameter : parameters)
        {
          std::vector<std::vector<std::string>> longer;
          for (const auto &values : result)
            for (const std::string &value : parameter.values)
              {
                longer.push_back(values);
                longer.back().push_back(value);
              }
          result = std::move(longer);
        }
      return result;
    }

    /// "Refinements_1_Form_energy": what a run differs in, as the name of its directory.
    std::string name_of_run(const std::vector<SweptParameter> &parameters,
                            const std::vector<std::string>    &values)
    {
      std::string name;
      for (std::size_t k = 0; k < values.size(); ++k)
        name += (k == 0 ? "" : "_") + parameters[k].path.substr(parameters[k].path.rfind('/') + 1) + "_" +
                values[k];
      for (char &letter : name)
        if (!std::isalnum(static_cast<unsigned char>(letter)) && letter != '.' && letter != '-' &&
            letter != '+')
          letter = '_';
      return name;
    }

    /// The command lines of all runs.
    std::vector<CommandLine> command_lines(const CommandLine                           &command_line,
                                           const std::vector<SweptParameter>           &parameters,
                                           const std::vector<std::vector<std::string>> &combinations,
                                           const std::string                           &directory)
    {
      std::vector<CommandLine> result;
      std::set<std::string>    names;
      for (const auto &values : combinations)
        {
          CommandLine one = command_line;
          one.action      = CommandLine::Action::run;
          for (std::size_t k = 0; k < values.size(); ++k)
            one.overrides.push_back(parameters[k].path + "=" + values[k]);
          std::string name = name_of_run(parameters, values);
          while (!names.insert(name).second)
            name += "_";
          one.overrides.push_back("Output directory=" + directory + "/" + name);
          result.push_back(one);
        }
      return result;
    }

    /// Runs one scene; a failure of it is told, and ends no more than it.
    /// @return whether it is done
    bool run_one(const CommandLine &command_line, const bool is_first_rank)
    {
      try
        {
          // What an earlier sweep left is not taken for the result of this one.
          std::error_code ignored;
          if (is_first_rank)
            std::filesystem::remove(output_directory(command_line) + "/summary.json", ignored);
          process_scene(command_line);
          return true;
        }
      catch (const ComputationError &error)
        {
          if (!all_ranks_arrive(MPI_COMM_WORLD))
            throw;
          if (is_first_rank)
            std::cerr << "perideal: computation failed: " << error.what() << std::endl;
          return false;
        }
    }

    void write_sweep(const std::string                 &directory,
                     const std::vector<SweptParameter> &parameters,
                     const std::vector<SweptRun>       &runs)
    {
      const auto         table = sweep_table(parameters, runs);
      std::ostringstream csv;
      for (const auto &row : table)
        write_csv_header(csv, row);
      replace_file(directory + "/sweep.csv", csv.str());
      std::cout << "\n"
                << report_table(table[0], {table.begin() + 1, table.end()}) << "\ntable in " << directory
                << "/sweep.csv\npictures    " << run_python_tool("sweep.py", {"--", directory}).in_one_line()
                << std::endl;
    }
  } // namespace

  SweptParameter read_swept_parameter(const std::string &text)
  {
    const std::size_t equals = text.find('=');
    SweptParameter    result;
    if (equals != std::string::npos)
      {
        result.path   = dealii::Utilities::trim(text.substr(0, equals));
        result.values = dealii::Utilities::split_string_list(text.substr(equals + 1),
                                                             text.find(';') == std::string::npos ? ',' : ';');
      }
    if (result.path.empty() || result.values.empty())
      throw InputError("--sweep needs a parameter and its values")
        .given(text)
        .allowed("--sweep \"Section/Name=value, value, ...\", with ; between values that hold commas");
    return result;
  }

  std::vector<std::vector<std::string>> sweep_table(const std::vector<SweptParameter> &parameters,
                                                    const std::vector<SweptRun>       &runs)
  {
    std::vector<std::vector<std::string>> rows(1);
    for (const SweptParameter &parameter : parameters)
      rows[0].push_back(parameter.path);
    rows[0].insert(rows[0].end(), {"status", "nodes", "strain energy [J]"});
    const auto names = comparisons_of(runs);
    for (const std::string &name : names)
      rows[0].insert(rows[0].end(), {"error against " + name + " [-]", "order against " + name + " [-]"});
    rows[0].push_back("seconds");
    for (std::size_t r = 0; r < runs.size(); ++r)
      {
        const Json              &summary = runs[r].summary;
        std::vector<std::string> row     = runs[r].values;
        row.push_back(summary.value("status", std::string("failed")));
        row.push_back(summary.contains("nodes") ? summary["nodes"].dump() : "");
        row.push_back(text_of_number(number_at(summary, "/energy/strain")));
        for (const std::string &name : names)
          {
            const std::string path = "/errors/" + name + "/l2";
            row.push_back(text_of_number(number_at(summary, path)));
            row.push_back(r == 0 ? "" : text_of_number(order_between(runs[r - 1], runs[r], path)));
          }
        row.push_back(text_of_number(number_at(summary, "/seconds/total")));
        rows.push_back(row);
      }
    return rows;
  }

  void run_sweep(const CommandLine &command_line)
  {
    std::vector<SweptParameter> parameters;
    for (const std::string &text : command_line.sweeps)
      parameters.push_back(read_swept_parameter(text));
    const std::string directory    = output_directory(command_line);
    const auto        combinations = all_combinations(parameters);
    const auto        scenes       = command_lines(command_line, parameters, combinations, directory);
    for (const CommandLine &scene : scenes)
      check_parameters(scene);

    const bool            is_first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    std::vector<SweptRun> runs;
    std::size_t           n_failed = 0;
    create_output_directory(directory, MPI_COMM_WORLD);
    for (std::size_t r = 0; r < scenes.size(); ++r)
      {
        const std::string own = output_directory(scenes[r]);
        if (is_first_rank)
          std::cout << (r == 0 ? "" : "\n") << "sweep       run " << r + 1 << " of " << scenes.size() << ", "
                    << own << std::endl;
        n_failed += !run_one(scenes[r], is_first_rank);
        runs.push_back({combinations[r], is_first_rank ? summary_in(own) : Json::object()});
      }
    write_together(MPI_COMM_WORLD, [&] {
      if (is_first_rank)
        write_sweep(directory, parameters, runs);
    });
    if (n_failed > 0)
      throw ComputationError(std::to_string(n_failed) + " of " + std::to_string(scenes.size()) +
                             " runs of the sweep");
  }
} // namespace perideal
