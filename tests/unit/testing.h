// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_unit_testing_h
#define perideal_tests_unit_testing_h

#include <perideal/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

/// Helpers of the unit tests.
namespace perideal::test
{
  /**
   * A directory of its own for one test, the same on all ranks, removed with
   * everything in it at the end. Construction and destruction are collective.
   */
  class TemporaryDirectory
  {
  public:
    TemporaryDirectory()
    {
      std::string name = (std::filesystem::temp_directory_path() / "perideal-XXXXXX").string();
      if (is_first_rank() && mkdtemp(name.data()) == nullptr)
        name.clear();
      directory = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, name, 0);
      if (directory.empty())
        throw std::runtime_error("cannot create a temporary directory");
    }

    TemporaryDirectory(const TemporaryDirectory &)            = delete;
    TemporaryDirectory &operator=(const TemporaryDirectory &) = delete;

    ~TemporaryDirectory()
    {
      MPI_Barrier(MPI_COMM_WORLD); // others may still read
      std::error_code ignored;
      if (is_first_rank())
        std::filesystem::remove_all(directory, ignored);
    }

    /// Path of the directory itself.
    std::string path() const { return directory.string(); }

    /// Path of a file in it.
    std::string path(const std::string &file) const { return (directory / file).string(); }

    /// Writes a file into it, seen by all ranks afterwards; returns its path. Collective.
    std::string write(const std::string &file, const std::string &content) const
    {
      if (is_first_rank())
        std::ofstream(directory / file, std::ios::binary) << content;
      MPI_Barrier(MPI_COMM_WORLD);
      return path(file);
    }

  private:
    static bool is_first_rank() { return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0; }

    std::filesystem::path directory;
  };

  /// Whole content of a file; an empty string when it cannot be read.
  inline std::string read_file(const std::string &path)
  {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }

  /// @p callable throws an @p Exception whose message contains all the words.
  /// A failure is reported at the line of the caller.
  template <typename Exception, typename Callable>
  void expect_error(Callable                      &&callable,
                    const std::vector<std::string> &words,
                    const char                     *file = __builtin_FILE(),
                    const int                       line = __builtin_LINE())
  {
    try
      {
        std::forward<Callable>(callable)();
      }
    catch (const Exception &error)
      {
        const std::string message = error.what();
        for (const std::string &word : words)
          if (message.find(word) == std::string::npos)
            ADD_FAILURE_AT(file, line) << "the message lacks \"" << word << "\":\n" << message;
        return;
      }
    catch (const std::exception &error)
      {
        ADD_FAILURE_AT(file, line) << "an exception of another type was thrown:\n" << error.what();
        return;
      }
    ADD_FAILURE_AT(file, line) << "nothing was thrown";
  }

  /// @p callable rejects the user's input with a message that contains all the words.
  template <typename Callable>
  void expect_input_error(Callable                      &&callable,
                          const std::vector<std::string> &words,
                          const char                     *file = __builtin_FILE(),
                          const int                       line = __builtin_LINE())
  {
    expect_error<InputError>(std::forward<Callable>(callable), words, file, line);
  }
} // namespace perideal::test

#endif
