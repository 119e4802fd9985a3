// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/parameters/gauge_parameters.h>
#include <perideal/parameters/named_texts.h>
#include <perideal/parameters/point_text.h>

namespace perideal
{
  void GaugeParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Gauges");
    gauges = named_texts<GaugeText>(file, "Gauges");
    for (GaugeText &text : gauges)
      {
        prm.enter_subsection(text.name);
        prm.add_parameter("From",
                          text.from,
                          "Where an extensometer holds on to the undeformed body: coordinates [m], separated "
                          "by commas, in the body or on its boundary (up to a tenth of a cell outside, where "
                          "that is curved)");
        prm.add_parameter("To",
                          text.to,
                          "Where its other end does: coordinates [m]. The stretch of the distance between "
                          "them, and by how much it grew, are in the history and in summary.json, by load "
                          "step");
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  template <int dim>
  std::vector<Gauge<dim>> read_gauges(const GaugeParameters &parameters)
  {
    std::vector<Gauge<dim>> result;
    for (const GaugeText &text : parameters.gauges)
      {
        const std::string section = "Gauges/" + text.name + "/";
        result.push_back({text.name,
                          read_point<dim>(text.from, section + "From"),
                          read_point<dim>(text.to, section + "To")});
        if (result.back().from == result.back().to)
          throw InputError("the gauge has no length").parameter(section + "To").given(text.to);
      }
    return result;
  }

  PERIDEAL_INSTANTIATE(read_gauges)
} // namespace perideal
