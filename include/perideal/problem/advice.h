// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_advice_h
#define perideal_problem_advice_h

#include <perideal/problem/problem.h>

#include <string>
#include <vector>

namespace perideal
{
  /// Which form suits the scene, and why, in one line.
  /// @param n_thin cells in parts of the body that are one cell thick, where
  ///   the face gradient has no linear fit
  std::string suitable_form(const SceneParameters &parameters, const GlobalIndex n_thin);

  /// Cells of all ranks that have no gradient across the part that they lie in. Needs
  /// problem.discretisation.gradients. Collective.
  template <int dim>
  GlobalIndex thin_cells(const Problem<dim> &problem);

  /// Adds what bonds that are missing at surfaces spoil, one line each. Collective.
  template <int dim>
  void warn_of_surfaces(const Problem<dim> &problem, std::vector<std::string> &result);

  /// Adds what forms with families make of parts that are few cells thick, and of irregular cells, with
  /// figures. Collective.
  template <int dim>
  void warn_of_few_cells(const Problem<dim> &problem, std::vector<std::string> &result);

  /// Adds cracks to follow whose origin is no tip of a precrack, where there are any, with the nearest one.
  /// Collective.
  template <int dim>
  void warn_of_crack_origins(const Problem<dim> &problem, std::vector<std::string> &result);

  /// What is likely to spoil the result or to stop the solver, one line each. Collective.
  template <int dim>
  std::vector<std::string> warnings(const Problem<dim> &problem);
} // namespace perideal

#endif
