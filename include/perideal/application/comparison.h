// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_comparison_h
#define perideal_application_comparison_h

#include <perideal/application/scene_parameters.h>
#include <perideal/application/scene_state.h>
#include <perideal/base/timing.h>

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /// Finite elements of a degree on the scene's own mesh, timed as "fem: ...".
  /// Appends to @p report what the solver did. Collective.
  /// @param solids by the mesh's material ids
  template <int dim>
  NodalField<dim> solve_fem(const SceneState<dim>       &scene,
                            const SolidsByMaterial<dim> &solids,
                            const double                 time,
                            const double                 tolerance,
                            const unsigned int           degree,
                            Timings                     &timings,
                            nlohmann::ordered_json      &report);

  /// Those of finite strain, as solved last, at the nodes.
  template <int dim>
  NodalField<dim> nonlinear_fem_at_nodes(const SceneState<dim> &scene);

  /// Q2 finite elements on a mesh of the body, refined, at the nodes. Collective.
  /// @param solids by the mesh's material ids
  template <int dim>
  NodalField<dim> solve_reference(const SceneState<dim>       &scene,
                                  const Mesh<dim>             &mesh,
                                  const SolidsByMaterial<dim> &solids,
                                  const int                    refinements,
                                  const double                 time,
                                  Timings                     &timings);

  /// The exact solution at the nodes.
  template <int dim>
  NodalField<dim>
  evaluate_exact(const SceneState<dim> &scene, const ComparisonParameters &parameters, const double time);

  /// Beginning and end of a line.
  /// @throws InputError on what are no two points.
  template <int dim>
  std::pair<dealii::Point<dim>, dealii::Point<dim>> ends_of(const LineText &line);

  /// @throws InputError on all ranks where a line misses the body. Collective.
  template <int dim>
  void check_lines(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const std::vector<LineText> &lines);

  /**
   * Errors of the displacement against every comparison of the scene, and of
   * the finite elements against reference and exact solution, in the form of
   * summary.json; writes profile_NAME.csv into the output directory. Collective.
   */
  template <int dim>
  nlohmann::ordered_json compare(const SceneState<dim>      &scene,
                                 const ComparisonParameters &parameters,
                                 const std::string          &output_directory);
} // namespace perideal

#endif
