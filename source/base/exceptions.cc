// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>

#include <utility>

namespace perideal
{
  InputError::InputError(std::string problem_)
    : problem(std::move(problem_))
  {
    compose();
  }

  InputError &InputError::parameter(const std::string &path)
  {
    parameter_path = path;
    compose();
    return *this;
  }

  InputError &InputError::location(const std::string &file_and_line)
  {
    where = file_and_line;
    compose();
    return *this;
  }

  InputError &InputError::given(const std::string &value)
  {
    given_value = value;
    compose();
    return *this;
  }

  InputError &InputError::allowed(const std::string &values)
  {
    allowed_values = values;
    compose();
    return *this;
  }

  InputError &InputError::nearest(const std::string &name)
  {
    nearest_value = name;
    compose();
    return *this;
  }

  InputError &InputError::hint(const std::string &advice_)
  {
    advice = advice_;
    compose();
    return *this;
  }

  void InputError::compose()
  {
    message             = (where.empty() ? "" : where + ": ") + problem;
    const auto add_line = [&](const char *label, const std::string &text) {
      if (!text.empty())
        message += std::string("\n  ") + label + text;
    };
    add_line("parameter:    ", parameter_path);
    add_line("given:        ", given_value);
    add_line("allowed:      ", allowed_values);
    add_line("did you mean: ", nearest_value);
    add_line("advice:       ", advice);
  }
} // namespace perideal
