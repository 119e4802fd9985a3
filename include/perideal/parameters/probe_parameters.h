// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_probe_parameters_h
#define perideal_parameters_probe_parameters_h

#include <perideal/parameters/parameter_file.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace perideal
{
  /// A subsection of "Probes", as text: a point of the body at which fields are recorded.
  struct ProbeText
  {
    std::string name;
    /// Coordinates [m], separated by commas.
    std::string point;
    std::string fields = "displacement";

    /// Its fields, in the order given.
    std::vector<std::string> field_names() const;
  };

  /// Section "Probes".
  struct ProbeParameters
  {
    std::vector<ProbeText> probes;

    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);
  };
} // namespace perideal

#endif
