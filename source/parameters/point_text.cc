// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/parameters/point_text.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <vector>

namespace perideal
{
  template <int dim>
  dealii::Point<dim> read_point(const std::string &text, const std::string &parameter)
  {
    const auto complain = [&]() {
      return InputError("not a point of the scene")
        .parameter(parameter)
        .given(text)
        .allowed(std::to_string(dim) + " coordinates [m], separated by commas");
    };
    const std::vector<std::string> coordinates = dealii::Utilities::split_string_list(text, ',');
    if (coordinates.size() != dim)
      throw complain();
    dealii::Point<dim> result;
    for (int d = 0; d < dim; ++d)
      {
        try
          {
            result[d] = dealii::Utilities::string_to_double(coordinates[d]);
          }
        catch (const dealii::ExceptionBase &)
          {
            throw complain();
          }
        if (!std::isfinite(result[d]))
          throw complain();
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(read_point)
} // namespace perideal
