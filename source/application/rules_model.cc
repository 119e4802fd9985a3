// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>
#include <perideal/base/registry.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

// Rules of models, their forms and their settings.

namespace perideal
{
  namespace
  {
    using Scene = SceneParameters;

    /// "MODEL: automatic | FORM | FORM; MODEL: ..." of the forms that fit.
    std::string list_of_forms(bool (*fits)(const FormTraits &))
    {
      std::vector<std::string> texts;
      for (const auto &[name, model] : ModelChoice::list())
        {
          std::vector<std::string> forms = {"automatic"};
          for (const FormTraits &form : model.forms)
            if (fits(form))
              forms.push_back(form.name);
          if (model.forms.size() > 1)
            texts.push_back(name + ": " + join_choices(forms));
        }
      return join_choices(texts, "; ");
    }

    bool has_another_models_form(const Scene &scene)
    {
      const auto &forms = scene.model.model->forms;
      return scene.model.has_forms() && std::none_of(forms.begin(), forms.end(), [&](const FormTraits &form) {
               return form.name == scene.model.form;
             });
    }

    bool has_bad_stabilisation(const Scene &scene)
    {
      // Where the form has none, its default stays.
      static const std::string automatic = ModelParameters().stabilisation;
      const std::string       &text      = scene.model.stabilisation;
      char                    *end       = nullptr;
      const double             value     = std::strtod(text.c_str(), &end);
      const bool               fits      = scene.model.is_consistent() ? value > 0 : value >= 0;
      return text != automatic && (text.empty() || *end != 0 || !fits || !std::isfinite(value));
    }

    /// Symmetries that the model's bonds do not have.
    std::vector<std::string> symmetries_of_isotropic_models(const Scene &scene)
    {
      std::vector<std::string> result;
      const auto               check = [&](const MaterialProperties &properties) {
        if (!properties.symmetry.is_isotropic() && !scene.model.takes_any_symmetry())
          result.push_back(properties.symmetry.section + "/Symmetry");
      };
      check(scene.material.body);
      for (const auto &group : scene.material.groups)
        check(group.second);
      return result;
    }

    /// Serves tangents, but not the motion that the solver wants.
    bool is_not_of_motion(const Scene &scene)
    {
      const Solvers &serves = scene.model.form_traits().solvers;
      return serves.quasi_statics && ((scene.solver.is_dynamic() && !serves.dynamics) ||
                                      (scene.solver.is_relaxation() && !serves.relaxation));
    }

    bool has_symmetry_without_law(const Scene &scene)
    {
      const auto without = [&](const MaterialProperties &properties) {
        return !properties.symmetry.is_isotropic() && !scene.model.law->takes_any_symmetry;
      };
      return scene.model.is_correspondence() &&
             (without(scene.material.body) ||
              std::any_of(scene.material.groups.begin(), scene.material.groups.end(), [&](const auto &group) {
                return without(group.second);
              }));
    }
  } // namespace

  std::vector<Rule> model_rules()
  {
    return {
      refuse("Material/Form",
             "another Material/Model has this form",
             has_another_models_form,
             "this is no form of the model",
             list_of_forms([](const FormTraits &) { return true; }) + "; here Material/Model = ..."),
      refuse(
        "Material/Form",
        "Material/Form = surface cure, with Solver/Name other than static",
        [](const Scene &s) { return s.model.is_linear_only() && !s.solver.is_linear_static(); },
        "this form is one of linear statics",
        list_of_forms([](const FormTraits &form) { return form.solvers.quasi_statics; }) +
          " with Solver/Name = ..."),
      refuse("Solver/Name",
             "Solver/Name = dynamic relaxation with Material/Form = consistent or Material/Model = "
             "correspondence; Solver/Name = dynamics with Material/Model = correspondence, Form = family",
             is_not_of_motion,
             "this form has no such solver",
             "static | quasi static; dynamics with Material/Form = consistent"),
      refuse(
        "Material/Law",
        "Material/Model other than correspondence",
        [](const Scene &s) { return !s.model.law->is_linear && !s.model.is_correspondence(); },
        "the bonds of this model have no law of the continuum",
        "linear elastic for Material/Model = ...",
        "or set Material/Model = correspondence"),
      refuse(
        "Material/Law",
        "Material/Model = correspondence, Solver/Name other than quasi static | dynamics",
        [](const Scene &s) {
          return !s.model.law->is_linear && s.model.is_correspondence() && !s.solver.is_quasi_static() &&
                 !s.solver.is_dynamic();
        },
        "large strain is sought along load steps or in motion",
        "linear elastic for Solver/Name = ...",
        "set Solver/Name = quasi static, or = dynamics"),
      refuse("Material/Law",
             "Material/Law = neo-Hookean, Material/NAME/Symmetry other than isotropic",
             has_symmetry_without_law,
             "this law is one of isotropic materials",
             "linear elastic | Saint Venant-Kirchhoff for materials of other symmetries"),
      refuse("Material/Stabilisation",
             "out of its range, which Material/Form = family widens",
             has_bad_stabilisation,
             "the stabilisation is out of range",
             "automatic, or a number > 0 (Material/Form = family: >= 0); without it the consistent form has "
             "modes without energy"),
      refuse(
        "Material/Multipliers",
        "Material/Model other than extended ordinary, or Material/Form = consistent",
        [](const Scene &s) { return s.model.after_the_cut() && !s.model.form_traits().has_multipliers; },
        "this model has no multipliers that a cut could change",
        "intact; or set Material/Model = extended ordinary with Form = energy | paper"),
      refuse(
        "Material/Multipliers",
        "Material/Multipliers = recomputed, Material/Form other than energy",
        [](const Scene &s) {
          return s.model.recomputes() && s.model.form_traits().has_multipliers &&
                 !s.model.form_traits().follows_from_energy;
        },
        "weights that change as bonds break need a force that follows from an energy",
        "intact | after the cut; or set Material/Form = energy"),
      refuse(
        "Material/Multipliers",
        "Material/Multipliers = recomputed, Solver/Name = quasi static | dynamic relaxation",
        [](const Scene &s) { return s.model.recomputes() && s.solver.is_nonlinear_static(); },
        "this belongs to dynamics",
        "intact | after the cut with Solver/Name = ...",
        "set Solver/Name = dynamics"),
      refuse(
        "Material/Multipliers",
        "Solver/Name = static",
        [](const Scene &s) { return s.model.after_the_cut() && s.solver.is_linear_static(); },
        "this belongs to dynamics, quasi static and dynamic relaxation",
        "intact with Solver/Name = static",
        "set Solver/Name = dynamics, or = quasi static"),
      refuse(
        "Material/Stretch formula",
        "Material/Stretch formula = tensor involved, Material/Model other than tensor involved",
        [](const Scene &s) {
          return s.model.stretch_formula == StretchFormula::tensor_involved && !s.model.is_tensor_involved();
        },
        "the bonds of this model have no tensors",
        "automatic | ordinary for Material/Model = ..."),
      refuse(
        "Material/Stretch formula",
        "Material/Stretch formula other than bonds, with Material/Fracture energies",
        [](const Scene &s) { return s.material.has_fracture_energies() && !s.model.calibrates_bonds(); },
        "the stretches of this formula know no direction",
        "automatic | bonds with Material/Fracture energies"),
      refuse(
        "Material/Boundary compensation",
        "Material/Model other than bond based",
        [](const Scene &s) { return s.model.compensates() && !s.model.model->has_one_micromodulus; },
        "only springs are stiffened near the surface",
        "none for Material/Model = ..."),
      refuse(
        "Material/Boundary compensation",
        "Boundary conditions/Displacement treatment = mirror",
        [](const Scene &s) { return s.model.compensates() && s.loads.has_mirror(); },
        "bonds to mirrored nodes are not missing",
        "none with Displacement treatment = mirror"),
      refuse(
        "Material/Compensation of a bond",
        "Material/Boundary compensation = none",
        [](const Scene &s) {
          return (s.model.compensation_of_a_bond != CompensationOfABond::mean) && !s.model.compensates();
        },
        "no bond has a factor",
        "mean; or set Material/Boundary compensation = numerical | closed form"),
      refuse(
        "Material/Compensation of a bond",
        "Quadrature/Scheme other than gauss points",
        [](const Scene &s) {
          return (s.model.compensation_of_a_bond != CompensationOfABond::mean) &&
                 !s.quadrature.has_gauss_points();
        },
        "bonds whose ends oppose each other have one factor",
        "mean; or set Quadrature/Scheme = gauss points"),
      refuse_each("Material/NAME/Symmetry",
                  "Material/Model = bond based | ordinary | extended ordinary",
                  symmetries_of_isotropic_models,
                  "this model is one of isotropic materials",
                  "isotropic; or set Material/Model = tensor involved | correspondence"),
      warn(
        "Material/Form",
        "Material/Model = extended ordinary, Material/Form = paper, Solver/Name = dynamics",
        [](const Scene &s) { return s.solver.is_dynamic() && !s.model.form_traits().follows_from_energy; },
        "the paper's forces follow from no energy: free motions may grow by themselves at any time step; "
        "Material/Form = energy conserves energy"),
      warn(
        "Material/Stabilisation",
        "Material/Model = correspondence, Material/Form = family, Material/Stabilisation = 0",
        [](const Scene &s) {
          return s.model.is_correspondence() && !s.model.is_consistent() &&
                 std::strtod(s.model.stabilisation.c_str(), nullptr) == 0;
        },
        "without a penalty the gradient of the family hardly sees some motions, which then cost next to "
        "no energy: take Material/Stabilisation = automatic"),
      warn(
        "Material/Poisson ratio",
        "above 0.45, with Material/Assumption = plane strain or in 3-D",
        [](const Scene &s) {
          const bool is_stress = s.dimension == 2 && s.material.assumption == PlaneAssumption::plane_stress;
          return !is_stress && s.material.body.poisson_ratio > 0.45;
        },
        "a Poisson's ratio above 0.45 is nearly incompressible: expect many iterations"),
    };
  }
} // namespace perideal
