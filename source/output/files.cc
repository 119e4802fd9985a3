// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/output/files.h>

#include <deal.II/base/mpi.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace perideal
{
  namespace
  {
    /// What stands in the way of writing in the directory; empty when nothing does.
    std::string try_directory(const std::filesystem::path &directory)
    {
      std::error_code error;
      std::filesystem::create_directories(directory, error);
      if (error)
        return "the output directory cannot be created (" + error.message() + ")";

      const auto    trial = directory / ".write_test";
      std::ofstream file(trial);
      file << "test" << std::flush;
      if (!file)
        return "no file can be written in the output directory";
      file.close();
      std::filesystem::remove(trial, error);
      return "";
    }
  } // namespace

  void create_output_directory(const std::string &directory, MPI_Comm communicator)
  {
    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      problem = directory.empty() ? "the output directory has no name" : try_directory(directory);
    problem = dealii::Utilities::MPI::broadcast(communicator, problem, 0);
    if (!problem.empty())
      throw InputError(problem)
        .parameter("Output directory")
        .given(directory)
        .allowed("a directory in which you may write; it is created where it does not exist");
  }

  void replace_file(const std::string &path, const std::string &text)
  {
    const std::string temporary = path + ".part";
    std::ofstream     file(temporary, std::ios::binary);
    file << text;
    file.close();
    std::error_code error;
    if (file)
      std::filesystem::rename(temporary, path, error);
    if (!file || error)
      throw ComputationError("cannot write '" + path + "': is the disk full?");
  }

  void write_csv_header(std::ostream &out, const std::vector<std::string> &names)
  {
    const char *separator = "";
    for (const std::string &name : names)
      {
        out << separator;
        separator = ",";
        if (name.find_first_of(",\"\n") == std::string::npos)
          {
            out << name;
            continue;
          }
        out << '"';
        for (const char c : name)
          out << (c == '"' ? "\"\"" : std::string(1, c));
        out << '"';
      }
    out << '\n';
  }

  void write_csv_row(std::ostream &out, const std::vector<double> &values)
  {
    const char *separator = "";
    char        number[32];
    for (const double value : values)
      {
        std::snprintf(number, sizeof(number), "%.17g", value);
        out << separator << number;
        separator = ",";
      }
    out << '\n';
  }

  std::vector<std::string> read_csv_header(const std::string &line)
  {
    std::vector<std::string> names(1);
    bool                     quoted = false;
    for (std::size_t k = 0; k < line.size(); ++k)
      if (line[k] == '"' && quoted && k + 1 < line.size() && line[k + 1] == '"')
        names.back() += line[k++];
      else if (line[k] == '"')
        quoted = !quoted;
      else if (line[k] == ',' && !quoted)
        names.emplace_back();
      else
        names.back() += line[k];
    return names;
  }

  std::vector<double> read_csv_row(const std::string &line)
  {
    std::vector<double> values;
    const char         *at = line.c_str();
    while (true)
      {
        char        *end   = nullptr;
        const double value = std::strtod(at, &end);
        if (end == at)
          return values;
        values.push_back(value);
        if (*end != ',')
          return values;
        at = end + 1;
      }
  }

  void write_csv(const std::string                      &path,
                 const std::vector<std::string>         &header,
                 const std::vector<std::vector<double>> &rows)
  {
    std::ostringstream text;
    write_csv_header(text, header);
    for (const auto &row : rows)
      write_csv_row(text, row);
    replace_file(path, text.str());
  }
} // namespace perideal
