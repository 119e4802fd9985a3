// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/named_texts.h>
#include <perideal/parameters/probe_parameters.h>

#include <deal.II/base/utilities.h>

namespace perideal
{
  std::vector<std::string> ProbeText::field_names() const
  {
    return dealii::Utilities::split_string_list(fields, ',');
  }

  void ProbeParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Probes");
    probes = named_texts<ProbeText>(file, "Probes");
    for (ProbeText &text : probes)
      {
        prm.enter_subsection(text.name);
        prm.add_parameter(
          "Point",
          text.point,
          "A point of the undeformed body at which fields are recorded: coordinates [m], "
          "separated by commas, in the body or on its boundary (up to a tenth of a cell outside, "
          "where that is curved)");
        prm.add_parameter(
          "Fields",
          text.fields,
          "Fields that are interpolated there, names as in Output/Fields, separated by commas. "
          "Their values are columns of the history, a row a step, and in summary.json by load "
          "step; precracks are not reached across, cracks that grow are");
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }
} // namespace perideal
