// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

#include <algorithm>

// Rules of loads: which models and solvers take them.

namespace perideal
{
  namespace
  {
    using Scene = SceneParameters;

    const char *const temperature = "Thermal strain/Temperature";

    bool is_heated(const Scene &scene)
    {
      return !scene.loads.temperature.empty();
    }

    bool expands(const MaterialProperties &material)
    {
      return material.thermal_expansion != 0.;
    }

    std::vector<Rule> thermal_rules()
    {
      return {
        refuse(
          temperature,
          "Material/Model other than correspondence, Material/Form other than consistent",
          [](const Scene &s) {
            return is_heated(s) && !s.model.is_consistent() && !s.model.is_correspondence();
          },
          "bonds of this model compare lengths with those at rest, and no length is kept for a heated bond",
          "none for this model",
          "set Material/Form = consistent, or Material/Model = correspondence"),
        refuse(
          temperature,
          "Material/Fracture energy, Critical stretch or Tensile strength with Solver/Name other than static",
          [](const Scene &s) { return is_heated(s) && can_break(s); },
          "bonds that may break are judged by their lengths, which heating changes without a stress",
          "none where bonds may break"),
        refuse(
          temperature,
          "Boundary conditions/Displacement treatment = mirror | surface nodes",
          [](const Scene &s) {
            return is_heated(s) && (s.loads.has_mirror() || s.loads.has_surface_nodes());
          },
          "nodes without a cell have no temperature",
          "none for Boundary conditions/Displacement treatment = ...",
          "take automatic | layer"),
        refuse(
          temperature,
          "Solver/Control = gauge | dissipated energy",
          [](const Scene &s) { return is_heated(s) && s.solver.is_controlled(); },
          "the control of load steps scales loads and supports, and not the temperature",
          "none for Solver/Control"),
        refuse(
          temperature,
          "Output/Boundary stress",
          [](const Scene &s) { return is_heated(s) && !s.boundary_stress.empty(); },
          "the recovery of stresses at a boundary takes no thermal strain",
          "none with Output/Boundary stress"),
        refuse(
          temperature,
          "Cracks/Energy release rates with Precracks/, Dimension = 2, Solver/Name other than dynamics",
          [](const Scene &s) {
            return is_heated(s) && s.cracks.energy_release_rates && !s.precracks.cracks.empty() &&
                   s.dimension == 2 && !s.solver.is_dynamic();
          },
          "the domain integral takes no thermal strain",
          "none with Cracks/Energy release rates"),
        refuse(
          temperature,
          "Comparison/FEM = true, Material/Model = correspondence, Solver/Name = quasi static",
          [](const Scene &s) {
            return is_heated(s) && s.comparison.fem && s.model.is_correspondence() &&
                   s.solver.is_quasi_static();
          },
          "finite elements at finite strain take no thermal strain",
          "none with Comparison/FEM for this model and solver"),
        refuse(
          temperature,
          "Comparison/Stiffness = families",
          [](const Scene &s) { return is_heated(s) && s.comparison.by_families(); },
          "of families the stiffness in the plane is measured, and heating needs that in space",
          "none for Comparison/Stiffness = families"),
        warn(
          temperature,
          "Material/Thermal expansion = 0",
          [](const Scene &s) {
            const auto &groups = s.material.groups;
            return is_heated(s) && !expands(s.material.body) &&
                   std::none_of(
                     groups.begin(), groups.end(), [](const auto &group) { return expands(group.second); });
          },
          "Thermal strain/Temperature has no effect here; no material has a Thermal expansion"),
      };
    }
    std::vector<std::string> sliding_where(const Scene &scene, const bool is_broken)
    {
      std::vector<std::string> result;
      for (const auto &condition : scene.loads.conditions)
        if (is_broken && !condition.normal_displacement.empty())
          result.push_back("Boundary conditions/" + condition.name + "/u_n");
      return result;
    }

    std::vector<Rule> sliding_rules()
    {
      return {
        refuse_each(
          "Boundary conditions/NAME/u_n",
          "Boundary conditions/Displacement treatment other than face value",
          [](const Scene &s) {
            return sliding_where(s, s.loads.displacement_treatment != DisplacementTreatment::face_value);
          },
          "Boundary conditions/Displacement treatment = ... holds components along the axes",
          "none for this treatment",
          "set Material/Form = consistent, or hold a plane along the axes by u_x, u_y or u_z = 0"),
        refuse_each(
          "Boundary conditions/NAME/u_n",
          "Solver/Linear solver = direct | trilinos cg | trilinos gmres",
          [](const Scene &s) { return sliding_where(s, solves_equations(s) && s.solver.assembles()); },
          "the matrix of faces that slide in any direction is not assembled",
          "none for this linear solver",
          "set Solver/Linear solver = automatic, or hold a plane along the axes by u_x, u_y or u_z = 0"),
      };
    }
    std::vector<std::string> springs_where(const Scene &scene, const bool is_broken)
    {
      std::vector<std::string> result;
      for (const auto &condition : scene.loads.conditions)
        if (is_broken && condition.spring.stiffness > 0)
          result.push_back("Boundary conditions/" + condition.name + "/Spring stiffness");
      return result;
    }

    std::vector<Rule> spring_rules()
    {
      const char *const springs = "Boundary conditions/NAME/Spring stiffness";
      return {
        refuse_each(
          springs,
          "Solver/Name other than static",
          [](const Scene &s) { return springs_where(s, !s.solver.is_linear_static()); },
          "springs at a boundary belong to linear statics",
          "0 for Solver/Name = ..."),
        refuse_each(
          springs,
          "Boundary conditions/Traction treatment other than face value",
          [](const Scene &s) {
            return springs_where(s, s.loads.traction_treatment != TractionTreatment::face_value);
          },
          "springs pull at the displacement of faces, which only the consistent form has",
          "0 for this treatment",
          "set Material/Form = consistent"),
        refuse_each(
          springs,
          "Solver/Linear solver = direct | trilinos cg | trilinos gmres",
          [](const Scene &s) { return springs_where(s, s.solver.assembles()); },
          "the matrix of springs at a boundary is not assembled",
          "0 for this linear solver",
          "set Solver/Linear solver = automatic"),
      };
    }
  } // namespace

  std::vector<Rule> load_rules()
  {
    std::vector<Rule> all = thermal_rules();
    for (const auto part : {sliding_rules, spring_rules})
      for (Rule &rule : part())
        all.push_back(std::move(rule));
    return all;
  }
} // namespace perideal
