// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_application_gauge_records_h
#define perideal_application_gauge_records_h

#include <perideal/boundary/gauges.h>
#include <perideal/output/history.h>

#include <nlohmann/json.hpp>

namespace perideal
{
  /// Adds columns to the row of the history. Collective.
  /// @param displacement of the nodes [m]
  /// @param summary part "gauges" of summary.json, which gets the readings of a load step, too: by name
  ///   "stretch" [-] and "elongation" [m], lists by load step; null: none of these
  template <int dim>
  void record_gauges(const Gauges<dim>      &gauges,
                     const NodalVector      &displacement,
                     History                &history,
                     nlohmann::ordered_json *summary);

  /// The same of finite elements beside the scene: columns "fem: stretch of ..." and the list "fem" by name,
  /// stretches by load step.
  /// @param displacements of Gauges::points() [m]
  template <int dim>
  void record_gauges(const Gauges<dim>                         &gauges,
                     const std::vector<dealii::Tensor<1, dim>> &displacements,
                     History                                   &history,
                     nlohmann::ordered_json                    &summary);
} // namespace perideal

#endif
