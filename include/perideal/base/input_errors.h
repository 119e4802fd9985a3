// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_base_input_errors_h
#define perideal_base_input_errors_h

#include <perideal/base/exceptions.h>

#include <vector>

namespace perideal
{
  /// Tells of several mistakes in the user's input; the message counts and names each.
  class InputErrors : public InputError
  {
  public:
    explicit InputErrors(std::vector<InputError> errors);

    const std::vector<InputError> &list() const { return errors; }

  private:
    std::vector<InputError> errors;
  };

  /// Keeps mistakes until all have been looked for.
  class InputErrorCollector
  {
  public:
    void add(InputError error) { errors.push_back(std::move(error)); }

    /// Calls a function and keeps the InputError, or InputErrors, that it throws.
    template <typename Function>
    void collect(const Function &function)
    {
      try
        {
          function();
        }
      catch (const InputErrors &several)
        {
          errors.insert(errors.end(), several.list().begin(), several.list().end());
        }
      catch (const InputError &one)
        {
          errors.push_back(one);
        }
    }

    const std::vector<InputError> &list() const { return errors; }

    /// @throws InputError where there is one mistake.
    /// @throws InputErrors where there are more.
    void raise() const;

  private:
    std::vector<InputError> errors;
  };
} // namespace perideal

#endif
