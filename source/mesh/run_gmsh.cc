// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/stop_request.h>
#include <perideal/mesh/mesh_file.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <spawn.h>
#include <sstream>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

extern char **environ;

namespace perideal
{
  namespace
  {
    /// A new directory, removed with its contents at the end of its life.
    class TemporaryDirectory
    {
    public:
      TemporaryDirectory()
      {
        name = (std::filesystem::temp_directory_path() / "perideal-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
          throw InputError("cannot make a temporary directory " + name + ": " + std::strerror(errno))
            .hint("set TMPDIR to a directory that can be written");
      }
      ~TemporaryDirectory()
      {
        std::error_code ignored;
        std::filesystem::remove_all(name, ignored);
      }
      TemporaryDirectory(const TemporaryDirectory &)            = delete;
      TemporaryDirectory &operator=(const TemporaryDirectory &) = delete;

      std::string file(const std::string &base) const { return name + "/" + base; }

    private:
      std::string name;
    };

    /// The environment without what mpirun put there: a gmsh that is linked
    /// with MPI would take itself for a rank of this run.
    std::vector<char *> environment_without_mpi()
    {
      std::vector<char *> variables;
      for (char **variable = environ; *variable != nullptr; ++variable)
        {
          const std::string_view text(*variable);
          bool                   is_from_mpi = false;
          for (const char *prefix : {"OMPI_", "PMIX_", "PMI_", "HYDI_", "MPIR_"})
            is_from_mpi = is_from_mpi || text.rfind(prefix, 0) == 0;
          if (!is_from_mpi)
            variables.push_back(*variable);
        }
      variables.push_back(nullptr);
      return variables;
    }

    /// Waits for gmsh, and ends it when the time is over or this process is asked to stop.
    /// Returns its status as waitpid() gives it.
    int wait_for(const pid_t process, const std::string &geo_file, const double time_limit)
    {
      using Clock = std::chrono::steady_clock;
      const StopRequest stop;
      const auto        begin  = Clock::now();
      const auto        end_it = [process] {
        int ignored = 0;
        kill(process, SIGKILL);
        while (waitpid(process, &ignored, 0) == -1 && errno == EINTR)
          ;
      };
      int n_minutes = 0;
      for (auto pause = std::chrono::milliseconds(1);;
           pause      = std::min(2 * pause, std::chrono::milliseconds(100)))
        {
               int         status   = 0;
               const pid_t finished = waitpid(process, &status, WNOHANG);
               if (finished == process)
            return status;
          if (finished == -1 && errno != EINTR)
            throw InputError("cannot wait for the program gmsh: " + std::string(std::strerror(errno)));
          const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
               if (stop.is_here())
            {
                   end_it();
                   throw Stopped("while gmsh meshed " + geo_file + "; gmsh was ended, nothing was computed");
            }
          if (seconds > time_limit)
            {
                   end_it();
                   std::ostringstream limit;
                   limit << time_limit;
                   throw InputError(geo_file + ": gmsh did not end within " + limit.str() + " s and was ended")
                     .hint("open the file in gmsh and mesh it there; choose larger sizes, mesh it once and give "
                           "the .msh "
                           "file, or raise Mesh/Gmsh time limit");
            }
          if (seconds > 60. * (n_minutes + 1))
            std::cout << "gmsh        still meshes " << geo_file << " after " << ++n_minutes << " min"
                      << std::endl;
          std::this_thread::sleep_for(pause);
        }
    }

    /// Runs gmsh, its output in a file. Returns its exit status, or 128 + signal.
    int run(std::vector<std::string> arguments,
            const std::string       &log,
            const std::string       &geo_file,
            const double             time_limit)
    {
      std::vector<char *> argv;
      for (std::string &argument : arguments)
        argv.push_back(argument.data());
      argv.push_back(nullptr);
      std::vector<char *> variables = environment_without_mpi();

      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
      posix_spawn_file_actions_addopen(
        &actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
      pid_t     process = 0;
      const int error   = posix_spawnp(&process, argv[0], &actions, nullptr, argv.data(), variables.data());
      posix_spawn_file_actions_destroy(&actions);
      if (error != 0)
        throw InputError("cannot run the program " + arguments[0] + ": " + std::strerror(error))
          .hint("install it (apt-get install gmsh), or mesh the file elsewhere and give the .msh file");

      const int status = wait_for(process, geo_file, time_limit);
      return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    }

    std::string text_of(const std::string &filename)
    {
      std::ifstream      stream(filename, std::ios::binary);
      std::ostringstream text;
      text << stream.rdbuf();
      return text.str();
    }

    /// Gmsh's first complaint; those behind it are mostly its consequences.
    std::string first_error(const std::string &log)
    {
      std::istringstream lines(log);
      std::string        line, last;
      while (std::getline(lines, line))
        {
          if (line.rfind("Error", 0) == 0)
            return line.substr(std::min(line.find(':') + 2, line.size()));
          if (!line.empty())
            last = line;
        }
      return last;
    }
  } // namespace

  std::string run_gmsh(const std::string &path, const int dim, const double time_limit)
  {
    // a name such as -x.geo would be an option
    const std::string        geo_file = path.front() == '-' ? "./" + path : path;
    const TemporaryDirectory directory;
    const std::string        mesh = directory.file("mesh.msh"), log = directory.file("log");

    // Format 2.2, because in 4.1 deal.II misreads groups with reversed curves
    // (negative tags)
    const int status =
      run({"gmsh", geo_file, dim == 2 ? "-2" : "-3", "-format", "msh22", "-o", mesh, "-v", "3"},
          log,
          geo_file,
          time_limit);
    const std::string text = text_of(mesh);
    if (status != 0 || text.empty())
      throw InputError(geo_file + ": gmsh failed (exit status " + std::to_string(status) +
                       "): " + first_error(text_of(log)))
        .hint("open the file in gmsh, or run: gmsh " + geo_file + (dim == 2 ? " -2" : " -3"));
    return text;
  }
} // namespace perideal
