// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

// Rules of meshes that adapt: where the error can be estimated.

namespace perideal
{
  std::vector<Rule> adaptation_rules()
  {
    using Scene              = SceneParameters;
    const char *const wanted = "Adaptation/Wanted error";
    return {
      refuse(
        wanted,
        "Solver/Name other than static",
        [](const Scene &s) {
          return s.adaptation.is_wanted() && (s.solver.is_dynamic() || s.solver.is_nonlinear_static());
        },
        "the error is estimated of linear equilibria",
        "0 for Solver/Name = ...",
        "take Mesh/Refine at for a mesh that is finer from the beginning"),
      refuse(
        wanted,
        "Material/Form other than consistent",
        [](const Scene &s) { return s.adaptation.is_wanted() && !s.model.is_consistent(); },
        "the error is estimated of what cells of the consistent form have for polynomials",
        "0 for this form",
        "set Material/Form = consistent"),
      refuse(
        wanted,
        "Thermal strain/Temperature",
        [](const Scene &s) { return s.adaptation.is_wanted() && !s.loads.temperature.empty(); },
        "the estimate of the error takes no thermal strain",
        "0 with Thermal strain/Temperature"),
    };
  }
} // namespace perideal
