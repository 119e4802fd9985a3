// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

#include <algorithm>

// Rules of what is written and compared.

namespace perideal
{
  namespace
  {
    using Scene = SceneParameters;

    /// Fields of bodies that move, and of bonds that break or are cut.
    const std::vector<std::string> fields_of_motion  = {"velocity"},
                                   fields_of_failure = {"damage", "precracks", "state"};

    bool has_any(const std::vector<std::string> &names, const std::vector<std::string> &fields)
    {
      return std::find_first_of(names.begin(), names.end(), fields.begin(), fields.end()) != names.end();
    }

    bool writes(const Scene &scene, const std::vector<std::string> &fields)
    {
      return has_any(scene.field_names(), fields);
    }

    /// Lists that name fields which the solver does not have.
    std::vector<std::string> lists_of_missing_fields(const Scene &scene)
    {
      const auto is_missing = [&](const std::vector<std::string> &names) {
        return (!scene.solver.is_dynamic() && has_any(names, fields_of_motion)) ||
               (scene.solver.is_linear_static() && has_any(names, fields_of_failure));
      };
      if (is_missing(scene.pictures.field_names()))
        return {"Output/Pictures"};
      return is_missing(scene.field_names()) ? std::vector<std::string>{"Output/Fields"} :
                                               std::vector<std::string>();
    }

    bool shows_what_is_not_compared(const Scene &scene)
    {
      const ComparisonParameters &comparison = scene.comparison;
      return (writes(scene, {"fem", "fem stress", "stress error"}) && !comparison.fem) ||
             (writes(scene, {"reference"}) && !comparison.reference) ||
             (writes(scene, {"exact"}) && !comparison.has_exact()) ||
             (writes(scene, {"error"}) && !comparison.fem && !comparison.reference &&
              !comparison.has_exact());
    }

    /// Probes with one of these fields where a condition holds.
    Rule::Breaches probes_where(const Condition condition, const std::vector<std::string> &fields)
    {
      return [condition, fields](const Scene &scene) {
        std::vector<std::string> result;
        for (const ProbeText &probe : scene.probes.probes)
          if (const auto names = probe.field_names();
              condition(scene) &&
              std::find_first_of(names.begin(), names.end(), fields.begin(), fields.end()) != names.end())
            result.push_back("Probes/" + probe.name + "/Fields");
        return result;
      };
    }

    std::vector<Rule> probe_rules()
    {
      return {
        refuse_each("Probes/NAME/Fields",
                    "velocity with Solver/Name = static | quasi static | dynamic relaxation",
                    probes_where([](const Scene &s) { return !s.solver.is_dynamic(); }, fields_of_motion),
                    "nothing moves in statics",
                    "other fields with Solver/Name = ...",
                    "remove it, or set Solver/Name = dynamics"),
        refuse_each(
          "Probes/NAME/Fields",
          "damage, precracks, state with Solver/Name = static",
          probes_where([](const Scene &s) { return s.solver.is_linear_static(); }, {"damage", "precracks"}),
          "nothing breaks in linear statics",
          "other fields with Solver/Name = ...",
          "remove it, or set Solver/Name = quasi static"),
        refuse_each(
          "Probes/NAME/Fields",
          "fem, reference, exact, error, fem stress, stress error, state",
          probes_where([](const Scene &) { return true; },
                       {"fem", "reference", "exact", "error", "fem stress", "stress error", "state"}),
          "a probe records what every step has; comparisons are made at the end, and the state has "
          "as many values as the model",
          "other fields")};
    }

    /// Whether the models' bonds know only their own ends.
    bool has_bonds_of_ends(const Scene &scene)
    {
      return scene.model.form_traits().bonds_know_only_their_ends;
    }

    bool has_whole_bonds(const Scene &scene)
    {
      return !can_break(scene) && scene.precracks.cracks.empty();
    }

    /// Areal force densities by the line rule where a condition holds.
    Rule::Breaches lines_where(const Condition condition)
    {
      return [condition](const Scene &scene) {
        std::vector<std::string> result;
        for (const ArealForceText &text : scene.areal_forces.points)
          if (text.rule == ArealForceRule::line && condition(scene))
            result.push_back("Areal force densities/" + text.name + "/Rule");
        return result;
      };
    }

    std::vector<std::string> areal_forces_of_correspondence(const Scene &scene)
    {
      std::vector<std::string> result;
      if (scene.model.is_correspondence())
        for (const ArealForceText &text : scene.areal_forces.points)
          result.push_back("Areal force densities/" + text.name);
      return result;
    }

    std::vector<std::string> comparisons(const Scene &scene)
    {
      std::vector<std::string> result;
      if (scene.comparison.fem)
        result.push_back("Comparison/FEM");
      if (scene.comparison.reference)
        result.push_back("Comparison/Reference");
      return result;
    }

    /// Components of the exact solution that are missing where others are given.
    std::vector<std::string> missing_components(const Scene &scene)
    {
      const char *const        axes[] = {"x", "y", "z"};
      std::vector<std::string> result;
      for (int d = 0; d < scene.dimension; ++d)
        if (scene.comparison.has_exact() && scene.comparison.exact[d].empty())
          result.push_back(std::string("Comparison/Exact u_") + axes[d]);
      return result;
    }

    std::vector<Rule> comparison_rules()
    {
      return {
        refuse_each(
          "Comparison/FEM, Reference",
          "Solver/Name = dynamics",
          [](const Scene &s) { return s.solver.is_dynamic() ? comparisons(s) : std::vector<std::string>(); },
          "the finite elements that dynamics would be compared with are static",
          "false in dynamics",
          "set it to false"),
        refuse_each(
          "Comparison/FEM, Reference",
          "Solver/Name other than dynamics, with Precracks/",
          [](const Scene &s) {
            return !s.solver.is_dynamic() && !s.precracks.cracks.empty() ? comparisons(s) :
                                                                           std::vector<std::string>();
          },
          "the finite elements that the solution would be compared with have no cracks",
          "false with Precracks",
          "set it to false, or remove the section Precracks"),
        refuse_each("Comparison/Exact u_x, u_y, u_z",
                    "another component of Comparison/Exact u_ is given",
                    missing_components,
                    "the exact solution lacks a component",
                    "a formula for every component, or none at all"),
        refuse(
          "Comparison/FEM degree",
          "Material/Model = correspondence, Solver/Name = quasi static | dynamic relaxation",
          [](const Scene &s) {
            return s.comparison.fem_degree != 1 && s.model.is_correspondence() &&
                   s.solver.is_nonlinear_static();
          },
          "finite elements of large strain are Q1",
          "1 for Material/Model = correspondence with Solver/Name = ..."),
        refuse(
          "Comparison/Reference refinements",
          "Comparison/Reference refinements = -1, Mesh/Refinements = 0",
          [](const Scene &s) { return s.comparison.reference_refinements < 0 && s.mesh.refinements == 0; },
          "the mesh of the reference cannot be coarser than one that was not refined",
          "0 to 4, or -1 where Mesh/Refinements is 1 or more"),
        refuse(
          "Comparison/Reference refinements",
          "Comparison/Reference refinements = -1, with Comparison/Reference mesh",
          [](const Scene &s) {
            return s.comparison.reference_refinements < 0 && !s.comparison.reference_mesh.empty();
          },
          "a mesh of its own for the reference is not refined before",
          "0 to 4 with a Reference mesh"),
        refuse(
          "Comparison/Reference mesh",
          "Comparison/Reference = false, Boundary conditions/Displacement treatment other than reference",
          [](const Scene &s) {
            return !s.comparison.reference_mesh.empty() && !s.comparison.reference &&
                   s.loads.displacement_treatment != DisplacementTreatment::reference;
          },
          "a mesh is given for a reference that is not asked for",
          "",
          "set Comparison/Reference = true, or remove it"),
      };
    }
  } // namespace

  std::vector<Rule> output_rules()
  {
    std::vector<Rule> result = {
      refuse_each(
        "Output/Fields, Pictures",
        "velocity with Solver/Name = quasi static | dynamic relaxation; velocity, damage, precracks, state "
        "with Solver/Name = static",
        lists_of_missing_fields,
        "these fields belong to dynamics (velocity), or to dynamics, quasi static and dynamic relaxation "
        "(damage, precracks, state)",
        "other fields with Solver/Name = ...",
        "remove them, or set Solver/Name = dynamics"),
      warn(
        "Output/Fields",
        "fem, fem stress, stress error, reference, exact or error without Comparison/FEM, Reference or Exact "
        "u_x, ...",
        shows_what_is_not_compared,
        "a field shows a comparison that is not asked for and is left out: set Comparison/FEM (fem, fem "
        "stress, stress error), "
        "Reference (reference), Exact u_x, ... (exact), or any of them (error)"),
      refuse(
        "Output/Boundary stress",
        "Solver/Name = dynamics",
        [](const Scene &s) { return s.solver.is_dynamic() && !s.boundary_stress.empty(); },
        "boundary stresses are those of statics",
        "none in dynamics"),
      refuse_each(
        "Areal force densities/NAME/Rule",
        "Areal force densities/NAME/Rule = line, Material/Model other than bond based, or tensor "
        "involved with Material/Form = one point",
        lines_where([](const Scene &s) { return !has_bonds_of_ends(s); }),
        "the line needs bonds that know only their own ends",
        "automatic | bonds for this model; or set Material/Model = bond based, or = tensor involved "
        "with Form = one point"),
      refuse_each("Areal force densities/NAME/Rule",
                  "Areal force densities/NAME/Rule = line, with bonds that break or that Precracks/ cut "
                  "(Solver/Name other than static)",
                  lines_where([](const Scene &s) { return has_bonds_of_ends(s) && !has_whole_bonds(s); }),
                  "the line takes all bonds for whole, and some may not be",
                  "automatic | bonds where bonds are cut or break"),
      refuse_each("Areal force densities/NAME",
                  "Material/Model = correspondence",
                  areal_forces_of_correspondence,
                  "bonds of the correspondence model carry the stresses of whole families",
                  "",
                  "remove it, or write Output/Fields = stress"),
    };
    for (const auto &more : {comparison_rules(), probe_rules()})
      result.insert(result.end(), more.begin(), more.end());
    return result;
  }
} // namespace perideal
