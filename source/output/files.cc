// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/links.h>
#include <perideal/output/files.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
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
    remove_link(temporary);
    std::ofstream file(temporary, std::ios::binary);
    file << text;
    file.close();
    finish_file(file.good(), temporary, path);
  }

  void write_together(MPI_Comm communicator, const std::function<void()> &write)
  {
    std::string problem;
    try
      {
        write();
      }
    catch (const ComputationError &error)
      {
        problem = error.what();
      }
    problem = dealii::Utilities::MPI::broadcast(communicator, problem, 0);
    if (!problem.empty())
      throw ComputationError(problem);
  }

  void finish_file(const bool is_written, const std::string &part, const std::string &path)
  {
    std::error_code error, none;
    if (is_written)
      std::filesystem::rename(part, path, error);
    if (is_written && !error)
      return;
    std::filesystem::remove(part, none);
    throw ComputationError("cannot write '" + path + "'" +
                           (error ? " (" + error.message() + ")" : ": is the disk full?"));
  }

  namespace
  {
    std::string this_process()
    {
      char host[256] = "";
      gethostname(host, sizeof(host) - 1);
      return "process " + std::to_string(getpid()) + " on host " + host;
    }

    /// Whether the path still leads to the open file, which its former holder may have removed.
    bool leads_to(const std::string &path, const int descriptor)
    {
      struct stat there, open;
      return stat(path.c_str(), &there) == 0 && fstat(descriptor, &open) == 0 &&
             there.st_ino == open.st_ino && there.st_dev == open.st_dev;
    }
  } // namespace

  DirectoryLock::DirectoryLock(const std::string &directory, MPI_Comm communicator)
    : path(directory + "/perideal.lock")
  {
    std::string holder = dealii::Utilities::MPI::this_mpi_process(communicator) == 0 ? take() : "";
    holder             = dealii::Utilities::MPI::broadcast(communicator, holder, 0);
    if (!holder.empty())
      throw InputError("another run writes its results into this directory")
        .parameter("Output directory")
        .given(directory)
        .allowed("a directory that no other run is using")
        .hint(holder + " holds perideal.lock there: wait for its end, or take another directory");
  }

  std::string DirectoryLock::take()
  {
    while (true)
      {
        descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        if (descriptor < 0)
          return "";
        if (flock(descriptor, LOCK_EX | LOCK_NB) != 0)
          {
            const bool    is_held = errno == EWOULDBLOCK;
            std::ifstream file(path);
            std::string   holder;
            std::getline(file, holder);
            close(descriptor);
            descriptor = -1;
            return !is_held ? "" : holder.empty() ? "another process" : holder;
          }
        if (leads_to(path, descriptor))
          break;
        close(descriptor);
      }
    const std::string text = this_process() + '\n';
    if (ftruncate(descriptor, 0) != 0 || pwrite(descriptor, text.data(), text.size(), 0) < 0)
      return ""; // The lock holds without a name.
    return "";
  }

  DirectoryLock::~DirectoryLock()
  {
    if (descriptor < 0)
      return;
    unlink(path.c_str());
    close(descriptor);
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
