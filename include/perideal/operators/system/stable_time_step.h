// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_stable_time_step_h
#define perideal_operators_system_stable_time_step_h

#include <perideal/operators/system/constrained_operator.h>

#include <functional>
#include <vector>

namespace perideal
{
  /**
   * Estimates the largest stable time step of explicit central differences, 2/omega_max [s], with
   * omega_max^2 the largest eigenvalue of M^-1 K from Lanczos steps, times 1.1
   * because they underestimate it; infinite where nothing is free to move. Collective.
   * @param density by material id [kg/m^3] @param moves by owned node: the others are held; empty: all move
   */
  template <int dim>
  double stable_time_step(const ConstrainedOperator<dim>                                &system,
                          const std::function<double(const dealii::types::material_id)> &density,
                          const std::vector<bool>                                       &moves = {});

  /// Levels of local steps.
  struct LocalStepLevels
  {
    /// By owned node, k where its step may be 2^k times the shortest one.
    std::vector<unsigned int> of_nodes;
    /// How many times shorter steps would have to be for many more nodes to be of one level more, such that
    /// they take less time; 1: there are no such nodes [-].
    double shortening = 1;
  };

  /**
   * Chooses levels by the diagonal of M^-1 K over that of the fastest node, so that what moves with a level
   * or a higher one, all others held, keeps a safe share of its largest stable step. Collective.
   * @param stable_of returns the largest stable step of some nodes with the others held [s]; empty: of all
   * @param step the shortest [s] @param safety that share [-] @param n_levels beyond the highest
   */
  template <int dim>
  LocalStepLevels local_step_levels(const ConstrainedOperator<dim>                                &system,
                                    const std::function<double(const dealii::types::material_id)> &density,
                                    const std::function<double(const std::vector<bool> &)>        &stable_of,
                                    const double                                                   step,
                                    const double                                                   safety,
                                    const unsigned int                                             n_levels);
} // namespace perideal

#endif
