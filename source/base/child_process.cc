// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/child_process.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char **environ;

namespace perideal
{
  namespace
  {
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

    /// A file without a name, which takes what a program prints.
    class PrintedText
    {
    public:
      PrintedText()
        : file(std::tmpfile(), &std::fclose)
      {
      }

      bool is_open() const { return file != nullptr; }
      int  descriptor() const { return fileno(file.get()); }

      std::string text() const
      {
        std::string result;
        char        part[4096];
        std::rewind(file.get());
        while (const std::size_t n = std::fread(part, 1, sizeof(part), file.get()))
          result.append(part, n);
        return result;
      }

    private:
      std::unique_ptr<std::FILE, int (*)(std::FILE *)> file;
    };

    /// Starts a program; returns the error number.
    int start_child(std::vector<std::string> &arguments, const int out, const int err, pid_t &process)
    {
      std::vector<char *> argv;
      for (std::string &argument : arguments)
        argv.push_back(argument.data());
      argv.push_back(nullptr);
      std::vector<char *> variables = environment_without_mpi();

      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
      posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
      posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
      posix_spawnattr_t attributes;
      posix_spawnattr_init(&attributes);
      posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
      const int error = posix_spawnp(&process, argv[0], &actions, &attributes, argv.data(), variables.data());
      posix_spawnattr_destroy(&attributes);
      posix_spawn_file_actions_destroy(&actions);
      return error;
    }

    /// Ends the group of a program, and waits for it.
    void end_child(const pid_t process)
    {
      int ignored = 0;
      kill(-process, SIGKILL);
      while (waitpid(process, &ignored, 0) == -1 && errno == EINTR)
        ;
    }

    /// Waits for a program; returns its status as waitpid() gives it.
    int wait_for_child(const pid_t process, const std::function<void(const double)> &watch)
    {
      using Clock      = std::chrono::steady_clock;
      const auto begin = Clock::now();
      for (auto pause = std::chrono::milliseconds(1);;
           pause      = std::min(2 * pause, std::chrono::milliseconds(100)))
        {
               int         status   = 0;
               const pid_t finished = waitpid(process, &status, WNOHANG);
               if (finished == process || (finished == -1 && errno != EINTR))
            return status;
          try
            {
                   watch(std::chrono::duration<double>(Clock::now() - begin).count());
            }
          catch (...)
            {
                   end_child(process);
                   throw;
            }
          std::this_thread::sleep_for(pause);
        }
    }
  } // namespace

  ChildResult run_child(std::vector<std::string>                         arguments,
                        const std::function<void(const double seconds)> &watch)
  {
    ChildResult       result;
    const PrintedText out, err;
    if (!out.is_open() || !err.is_open())
      {
        result.not_started = "no temporary file: " + std::string(std::strerror(errno));
        return result;
      }
    pid_t process = 0;
    if (const int error = start_child(arguments, out.descriptor(), err.descriptor(), process); error != 0)
      {
        result.not_started = std::strerror(error);
        return result;
      }
    const int status = wait_for_child(process, watch);
    result.status    = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
    result.out       = out.text();
    result.err       = err.text();
    return result;
  }
} // namespace perideal
