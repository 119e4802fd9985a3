// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_exceptions_h
#define perideal_base_exceptions_h

#include <exception>
#include <string>

namespace perideal
{
  /**
   * Tells that the user's input is wrong: the program ends with exit status 1.
   *
   * A message is composed of named parts, so that every one of them tells the
   * user where the mistake is, what was given and what is allowed:
   * @code
   * throw InputError("the horizon factor must be positive")
   *   .parameter("Nodes/Horizon factor").given("-3").allowed("a number > 1");
   * @endcode
   * The application adds the file, the line and the given value of a named
   * parameter where the thrower does not know them.
   *
   * Must be thrown on all ranks alike (input is read by every rank); use
   * ComputationError for what a single rank may meet.
   */
  class InputError : public std::exception
  {
  public:
    explicit InputError(std::string problem);

    /// Path of the offending parameter, "Section/Subsection/Name".
    InputError &parameter(const std::string &path);
    /// File (with line, cell, ... where known) in which the mistake stands.
    InputError &location(const std::string &file_and_line);
    /// The value as the user wrote it.
    InputError &given(const std::string &value);
    /// What would have been accepted.
    InputError &allowed(const std::string &values);
    /// A valid name close to the given one; an empty string is ignored.
    InputError &nearest(const std::string &name);
    /// What the user may do about it.
    InputError &hint(const std::string &advice);

    const std::string &parameter() const { return parameter_path; }
    bool               has_location() const { return !where.empty(); }
    bool               has_given() const { return !given_value.empty(); }

    const char *what() const noexcept override { return message.c_str(); }

  private:
    void compose();

    std::string problem, parameter_path, where, given_value, allowed_values, nearest_value, advice;
    std::string message;
  };

  /**
   * Tells that the computation failed (no convergence, NaN, out of memory): the program
   * ends with exit status 2, with what was computed until then on disk.
   * May be thrown by a single rank.
   */
  class ComputationError : public std::exception
  {
  public:
    explicit ComputationError(std::string problem)
      : message(std::move(problem))
    {
    }

    const char *what() const noexcept override { return message.c_str(); }

  private:
    std::string message;
  };

  /// The program was asked to stop, and did so where it can go on from: exit status 2. Thrown by all ranks.
  class Stopped : public std::exception
  {
  public:
    explicit Stopped(std::string what_was_done)
      : message(std::move(what_was_done))
    {
    }

    const char *what() const noexcept override { return message.c_str(); }

  private:
    std::string message;
  };
} // namespace perideal

#endif
