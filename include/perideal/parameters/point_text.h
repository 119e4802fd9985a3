// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_point_text_h
#define perideal_parameters_point_text_h

#include <deal.II/base/point.h>

#include <string>

namespace perideal
{
  /// A point from its coordinates [m], separated by commas.
  /// @param parameter path of the parameter, for the message
  /// @throws InputError on other text, or another number of coordinates.
  template <int dim>
  dealii::Point<dim> read_point(const std::string &text, const std::string &parameter);
} // namespace perideal

#endif
