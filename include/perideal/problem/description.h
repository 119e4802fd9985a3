// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_description_h
#define perideal_problem_description_h

#include <perideal/problem/problem.h>

#include <nlohmann/json.hpp>

#include <string>

namespace perideal
{
  /// Returns the parts of summary.json that describe the discretisation: mesh, nodes, bonds, neighbours,
  /// model. Collective.
  template <int dim>
  nlohmann::ordered_json describe_discretisation(const Problem<dim> &problem);

  /// Returns what the scene does not need, whatever drives it, by name with the amount saved.
  template <int dim>
  nlohmann::ordered_json list_skipped(const Problem<dim> &problem);

  /// Returns the lines that say what will be done. Collective.
  /// @param of_driver lines of the driver
  /// @param skipped names of what is not needed
  template <int dim>
  std::string
  banner(const Problem<dim> &problem, const std::string &of_driver, const nlohmann::ordered_json &skipped);
} // namespace perideal

#endif
