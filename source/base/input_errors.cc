// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>

#include <string>

namespace perideal
{
  namespace
  {
    std::string numbered(const std::vector<InputError> &errors)
    {
      std::string text = std::to_string(errors.size()) + " mistakes";
      for (std::size_t k = 0; k < errors.size(); ++k)
        text += "\n(" + std::to_string(k + 1) + ") " + errors[k].what();
      return text;
    }
  } // namespace

  InputErrors::InputErrors(std::vector<InputError> errors_)
    : InputError(numbered(errors_))
    , errors(std::move(errors_))
  {
  }

  void InputErrorCollector::raise() const
  {
    if (errors.size() == 1)
      throw errors.front();
    if (!errors.empty())
      throw InputErrors(errors);
  }
} // namespace perideal
