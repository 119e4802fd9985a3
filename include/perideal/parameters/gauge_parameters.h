// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_gauge_parameters_h
#define perideal_parameters_gauge_parameters_h

#include <perideal/parameters/parameter_file.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace perideal
{
  /// A subsection of "Gauges", as text.
  struct GaugeText
  {
    std::string name;
    /// Coordinates [m], separated by commas.
    std::string from, to;
  };

  /// Section "Gauges".
  struct GaugeParameters
  {
    std::vector<GaugeText> gauges;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);
  };

  /// An extensometer: two points of the body, whose distance it measures.
  template <int dim>
  struct Gauge
  {
    std::string        name;
    dealii::Point<dim> from, to;
  };

  /// The gauges.
  /// @throws InputError on text that is no point, and on points that are the same.
  template <int dim>
  std::vector<Gauge<dim>> read_gauges(const GaugeParameters &parameters);
} // namespace perideal

#endif
