// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/gauge_records.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  void record_gauges(const Gauges<dim>      &gauges,
                     const NodalVector      &displacement,
                     History                &history,
                     nlohmann::ordered_json *summary)
  {
    const auto readings = gauges.read(displacement);
    for (std::size_t k = 0; k < readings.size(); ++k)
      {
        const std::string &name = gauges.list()[k].name;
        history.add("stretch of " + name + " [-]", readings[k].stretch);
        history.add("elongation of " + name + " [m]", readings[k].elongation);
        if (summary == nullptr)
          continue;
        (*summary)[name]["stretch"].push_back(readings[k].stretch);
        (*summary)[name]["elongation"].push_back(readings[k].elongation);
      }
  }

  template <int dim>
  void record_gauges(const Gauges<dim>                         &gauges,
                     const std::vector<dealii::Tensor<1, dim>> &displacements,
                     History                                   &history,
                     nlohmann::ordered_json                    &summary)
  {
    const auto readings = gauges.read(displacements);
    for (std::size_t k = 0; k < readings.size(); ++k)
      {
        const std::string &name = gauges.list()[k].name;
        history.add("fem: stretch of " + name + " [-]", readings[k].stretch);
        summary[name]["fem"].push_back(readings[k].stretch);
        const double difference =
          std::abs(readings[k].stretch - summary[name]["stretch"].back().template get<double>());
        summary[name]["largest_difference"] =
          std::max(difference, summary[name].value("largest_difference", 0.));
      }
  }

  template void record_gauges(const Gauges<2> &,
                              const std::vector<dealii::Tensor<1, 2>> &,
                              History &,
                              nlohmann::ordered_json &);
  template void record_gauges(const Gauges<3> &,
                              const std::vector<dealii::Tensor<1, 3>> &,
                              History &,
                              nlohmann::ordered_json &);
  template void record_gauges(const Gauges<2> &, const NodalVector &, History &, nlohmann::ordered_json *);
  template void record_gauges(const Gauges<3> &, const NodalVector &, History &, nlohmann::ordered_json *);
} // namespace perideal
