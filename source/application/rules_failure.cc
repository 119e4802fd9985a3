// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/application/rules.h>

// Rules of what breaks, is cut or is followed.

namespace perideal
{
  namespace
  {
    using Scene = SceneParameters;

    bool softens_by_stress(const Scene &scene)
    {
      return scene.material.has_criterion() && scene.material.softens();
    }

    /// The bonds of the zone have one stiffness in all directions, and do not change it with strain.
    bool is_linear_and_isotropic(const Scene &scene)
    {
      const auto isotropic = [](const MaterialProperties &m) { return m.symmetry.is_isotropic(); };
      return scene.model.law->takes_any_symmetry && isotropic(scene.material.body) &&
             std::all_of(scene.material.groups.begin(), scene.material.groups.end(), [&](const auto &group) {
               return isotropic(group.second);
             });
    }

    std::vector<std::string> stretches_of_bonds_that_break_by_stress(const Scene &scene)
    {
      std::vector<std::string> result;
      const auto               check = [&](const MaterialProperties &properties, const std::string &section) {
        if (!scene.model.is_correspondence() || softens_by_stress(scene))
          return;
        if (properties.mean_fracture_energy() > 0)
          result.push_back(section +
                           (properties.fracture_energy > 0 ? "/Fracture energy" : "/Fracture energies"));
        else if (properties.critical_stretch > 0)
          result.push_back(section + "/Critical stretch");
      };
      check(scene.material.body, "Material");
      for (const auto &group : scene.material.groups)
        check(group.second, "Material/" + group.first);
      return result;
    }

    /// Paths of named subsections, in linear statics.
    template <typename Named>
    std::vector<std::string>
    in_statics(const Scene &scene, const std::string &section, const std::vector<Named> &named)
    {
      std::vector<std::string> result;
      if (scene.solver.is_linear_static())
        for (const Named &subsection : named)
          result.push_back(section + "/" + subsection.name);
      return result;
    }

    /// The same of forms that know no cracks in linear statics.
    template <typename Named>
    std::vector<std::string>
    in_statics_of_bonds(const Scene &scene, const std::string &section, const std::vector<Named> &named)
    {
      return scene.model.is_consistent() ? std::vector<std::string>() : in_statics(scene, section, named);
    }

    Rule of_motion(const std::string &parameter, const Rule::Breaches &breaches)
    {
      return refuse_each(parameter,
                         "Solver/Name = static",
                         breaches,
                         "this belongs to dynamics, quasi static and dynamic relaxation",
                         "",
                         "set Solver/Name = dynamics, or = quasi static");
    }

    Rule of_cracks(const std::string &parameter, const Rule::Breaches &breaches)
    {
      return refuse_each(parameter,
                         "Solver/Name = static, Material/Form other than consistent",
                         breaches,
                         "in linear statics the consistent form alone has cracks",
                         "",
                         "set Material/Form = consistent, or Solver/Name = dynamics or = quasi static");
    }
  } // namespace

  std::vector<Rule> failure_rules()
  {
    return {
      refuse(
        "Material/Failure criterion",
        "Material/Softening = none, Material/Model other than correspondence",
        [](const Scene &s) {
          return s.material.has_criterion() && !s.material.softens() && !s.model.is_correspondence();
        },
        "the bonds of this model break by stretch",
        "none for Material/Model = ... with Material/Softening = none",
        "set Material/Fracture energy or Critical stretch, and Material/Softening for bonds that a stress "
        "starts"),
      refuse(
        "Material/Failure criterion",
        "Material/Softening other than none, Material/Form other than consistent",
        [](const Scene &s) { return softens_by_stress(s) && !s.model.is_consistent(); },
        "bonds whose softening a stress starts are those that the consistent form turns into",
        "none for this Material/Form",
        "set Material/Form = consistent of Material/Model = extended ordinary or correspondence"),
      refuse(
        "Material/Softening",
        "Material/Softening other than none, Material/Failure criterion = none, Material/Model = "
        "correspondence",
        [](const Scene &s) {
          return s.material.softens() && !s.material.has_criterion() && s.model.is_correspondence();
        },
        "the bonds of this model break by stress",
        "none for Material/Model = correspondence without Material/Failure criterion"),
      refuse(
        "Material/Softening",
        "Material/Softening other than none, Material/Model = correspondence, with a Material/Law that is "
        "not "
        "linear or a Symmetry other than isotropic",
        [](const Scene &s) {
          return s.material.softens() && s.model.is_correspondence() && !is_linear_and_isotropic(s);
        },
        "the bonds that cells turn into where they soften are those of an isotropic, linear solid",
        "none for this solid",
        "set Material/Law = linear elastic or = Saint Venant-Kirchhoff"),
      refuse(
        "Material/Multipliers",
        "Material/Multipliers = recomputed, Material/Softening other than none",
        [](const Scene &s) { return s.material.softens() && s.model.recomputes(); },
        "families are weighed anew as bonds break, which softening bonds do little by little",
        "intact | after the cut with Material/Softening"),
      refuse_each("Material/NAME/Fracture energy, Critical stretch",
                  "Material/Model = correspondence",
                  stretches_of_bonds_that_break_by_stress,
                  "the bonds of this model break by stress",
                  "0 for Material/Model = correspondence",
                  "set Material/Failure criterion and Tensile strength"),
      refuse(
        "Material/Form",
        "Material/Form = consistent, Material/Model other than extended ordinary, with what breaks bonds "
        "(Material/Fracture energy, Critical stretch, Failure criterion) and Solver/Name other than static; "
        "of "
        "Material/Model = correspondence with Material/Softening = none",
        [](const Scene &s) {
          return has_fracture_zone(s) &&
                 (!s.model.grows_by_softening() || (s.model.is_correspondence() && !s.material.softens()));
        },
        "cracks do not grow in the consistent form of this model",
        "automatic where bonds break; consistent with Precracks alone",
        "or set Material/Model = extended ordinary, or Material/Softening and Fracture energy for Failure "
        "criterion"),
      refuse_each(
        "Cracks/NAME/Branch length",
        "Dimension = 3",
        [](const Scene &s) {
          std::vector<std::string> result;
          for (const CrackText &crack : s.cracks.cracks)
            if (s.dimension == 3 && crack.branch_length > 0)
              result.push_back("Cracks/" + crack.name + "/Branch length");
          return result;
        },
        "branches are looked for in two dimensions",
        "0 in 3-D"),
      refuse_each(
        "Cracks/NAME/Domain radius",
        "Dimension = 3, Solver/Name = dynamics, Cracks/Energy release rates = false",
        [](const Scene &s) {
          std::vector<std::string> result;
          for (const CrackText &crack : s.cracks.cracks)
            if (crack.domain_radius > 0 &&
                (s.dimension == 3 || s.solver.is_dynamic() || !s.cracks.energy_release_rates))
              result.push_back("Cracks/" + crack.name + "/Domain radius");
          return result;
        },
        "energy release rates are integrated in equilibria of plane bodies, where they are asked for",
        "0 for this scene"),
      of_cracks("Precracks/NAME",
                [](const Scene &s) { return in_statics_of_bonds(s, "Precracks", s.precracks.cracks); }),
      of_cracks("Cracks/NAME",
                [](const Scene &s) { return in_statics_of_bonds(s, "Cracks", s.cracks.cracks); }),
      of_motion("No-fail zones/NAME",
                [](const Scene &s) { return in_statics(s, "No-fail zones", s.no_fail.zones); }),
    };
  }
} // namespace perideal
