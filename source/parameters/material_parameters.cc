// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/parameters/material_parameters.h>
#include <perideal/parameters/parameter_file.h>

namespace perideal
{
  namespace
  {
    using dealii::Patterns::Double;

    /// Declares the properties of one material; defaults are texts, so that a
    /// group can take over what the whole body was given.
    void declare_properties(dealii::ParameterHandler &prm,
                            MaterialProperties       &properties,
                            const ParameterFile      &file,
                            const bool                is_group)
    {
      const auto declare = [&](const std::string &name, double &value, const std::string &meaning) {
        if (is_group)
          {
            const std::string inherited = file.value_of("Material/" + name, "");
            if (Double().match(inherited))
              value = std::stod(inherited);
          }
        prm.add_parameter(name, value, meaning, Double());
      };
      declare("Young modulus", properties.young_modulus, "Young's modulus E > 0 [Pa]");
      declare("Poisson ratio", properties.poisson_ratio, "Poisson's ratio, -1 < nu < 0.5 [-]");
      declare("Density", properties.density, "Mass density > 0 [kg/m^3], of dynamics");
      declare("Fracture energy",
              properties.fracture_energy,
              "Energy to open a unit of crack surface >= 0 [J/m^2]; 0: unbreakable; "
              "each bond breaks at the critical stretch that makes it so");
      declare("Critical stretch",
              properties.critical_stretch,
              "Stretch at which bonds break >= 0 [-]; 0: from the fracture energy");
    }

    void check_properties(const MaterialProperties &properties,
                          const std::string        &section,
                          const std::string        &assumption)
    {
      if (!(properties.young_modulus > 0))
        throw InputError("Young's modulus must be positive")
          .parameter(section + "/Young modulus")
          .allowed("a number > 0");
      if (!(properties.poisson_ratio > -1 && properties.poisson_ratio < 0.5))
        throw InputError("Poisson's ratio is outside the range of a stable elastic solid")
          .parameter(section + "/Poisson ratio")
          .allowed("-1 < nu < 0.5")
          .hint(assumption == "plane stress" ? "" : "nu = 0.5 is incompressible: take a value such as 0.49");
      if (!(properties.density > 0))
        throw InputError("the density must be positive")
          .parameter(section + "/Density")
          .allowed("a number > 0");
      if (!(properties.critical_stretch >= 0))
        throw InputError("the critical stretch must not be negative")
          .parameter(section + "/Critical stretch")
          .allowed("a number >= 0");
      if (properties.critical_stretch > 0 && properties.fracture_energy > 0)
        throw InputError("fracture energy and critical stretch are both given")
          .parameter(section + "/Critical stretch")
          .hint("remove one of them: each follows from the other");
      if (!(properties.fracture_energy >= 0))
        throw InputError("the fracture energy must not be negative")
          .parameter(section + "/Fracture energy")
          .allowed("a number >= 0");
    }
  } // namespace

  void MaterialParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Material");
    prm.add_parameter("Assumption",
                      assumption,
                      "How a 2-D body stands in space; without meaning in 3-D",
                      dealii::Patterns::Selection("plane stress|plane strain"));
    declare_properties(prm, body, file, false);
    for (const std::string &group : file.subsections("Material"))
      {
        prm.enter_subsection(group);
        declare_properties(prm, groups[group], file, true);
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  void MaterialParameters::check() const
  {
    check_properties(body, "Material", assumption);
    for (const auto &group : groups)
      check_properties(group.second, "Material/" + group.first, assumption);
  }

  ElasticConstants MaterialParameters::elastic_constants(const MaterialProperties &material,
                                                         const int                 dim) const
  {
    const PlaneAssumption plane =
      assumption == "plane strain" ? PlaneAssumption::plane_strain : PlaneAssumption::plane_stress;
    return {material.young_modulus, material.poisson_ratio, dim == 3 ? PlaneAssumption::solid : plane};
  }
} // namespace perideal
