// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

// Rules of meshes that adapt: where the error can be estimated.

namespace perideal
{
  std::vector<Rule> adaptation_rules()
  {
    using Scene              = SceneParameters;
    const char *const wanted = "Adaptation/Wanted error";
    const char *const levels = "Adaptation/Levels";
    return {
      refuse(
        wanted,
        "Solver/Name other than static",
        [](const Scene &s) {
          return s.adaptation.is_by_error() && (s.solver.is_dynamic() || s.solver.is_nonlinear_static());
        },
        "the error is estimated of linear equilibria",
        "0 for Solver/Name = ...",
        "take Mesh/Refine at for a mesh that is finer from the beginning"),
      refuse(
        wanted,
        "Material/Form other than consistent",
        [](const Scene &s) { return s.adaptation.is_by_error() && !s.model.is_consistent(); },
        "the error is estimated of what cells of the consistent form have for polynomials",
        "0 for this form",
        "set Material/Form = consistent"),
      refuse(
        wanted,
        "Thermal strain/Temperature",
        [](const Scene &s) { return s.adaptation.is_by_error() && !s.loads.temperature.empty(); },
        "the estimate of the error takes no thermal strain",
        "0 with Thermal strain/Temperature"),
      refuse(
        levels,
        "Solver/Name = static | dynamic relaxation",
        [](const Scene &s) {
          return s.adaptation.is_by_need() && !s.solver.is_dynamic() && !s.solver.is_quasi_static();
        },
        "the mesh changes between the steps of a motion or of quasi statics",
        "0 for this solver",
        "set Solver/Name = quasi static, or in linear statics Adaptation/Wanted error"),
      refuse(
        levels,
        "Adaptation/Wanted error",
        [](const Scene &s) { return s.adaptation.is_by_need() && s.adaptation.is_by_error(); },
        "a mesh adapts by its error or by need, not by both",
        "0 with Adaptation/Wanted error"),
      refuse(
        levels,
        "Nodes/Perturbation, Quadrature/Scheme = gauss points",
        [](const Scene &s) {
          return s.adaptation.is_by_need() && (s.nodes.perturbation > 0 || s.quadrature.has_gauss_points());
        },
        "what lasts is carried between centroids of cells",
        "0 with other nodes"),
      refuse(
        levels,
        "Thermal strain/Temperature",
        [](const Scene &s) { return s.adaptation.is_by_need() && !s.loads.temperature.empty(); },
        "what heating did to cells is not carried to halves of these",
        "0 with Thermal strain/Temperature"),
      refuse(
        levels,
        "neither bonds that can fail, nor Precracks, nor Adaptation/Refine where, at or in",
        [](const Scene &s) {
          return s.adaptation.is_by_need() && !can_break(s) && s.precracks.cracks.empty() &&
                 !s.adaptation.has_regions();
        },
        "nothing says where cells are to be smaller",
        "0 for this scene",
        "give Material/Fracture energy, or a formula in Adaptation/Refine where, or names in Refine at or "
        "in"),
    };
  }
} // namespace perideal
