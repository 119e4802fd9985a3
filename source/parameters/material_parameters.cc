// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>
#include <perideal/parameters/inherited_parameter.h>
#include <perideal/parameters/material_parameters.h>
#include <perideal/parameters/parameter_file.h>

#include <algorithm>
#include <numeric>

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
                            const std::string        &section)
    {
      const auto declare = [&](const std::string &name, double &value, const std::string &meaning) {
        declare_inherited(prm, file, section, name, value, meaning, Double());
      };
      properties.symmetry.declare(prm, file, section);
      declare("Young modulus",
              properties.young_modulus,
              "Young's modulus E > 0 [Pa] of an isotropic material; the scene must give it, the default is "
              "nobody's");
      declare(
        "Poisson ratio",
        properties.poisson_ratio,
        "Poisson's ratio, -1 < nu < 0.5 [-], of an isotropic material; the scene must give it unless the "
        "model has one of its own");
      declare("Density",
              properties.density,
              "Mass density > 0 [kg/m^3], of dynamics and gravity, where the scene must give it");
      declare("Thermal expansion",
              properties.thermal_expansion,
              "Coefficient of thermal expansion [1/K], the same in all directions");
      declare("Fracture energy",
              properties.fracture_energy,
              "Energy to open a unit of crack surface >= 0 [J/m^2]; 0: unbreakable; "
              "each bond breaks at the critical stretch that makes it so");
      declare_inherited(
        prm,
        file,
        section,
        "Fracture energies",
        properties.fracture_energies,
        "Fracture energies > 0 [J/m^2] by direction instead: of cracks normal to the material's "
        "axes 1, 2 (3-D: 3), which Orientation turns. A crack of the normal n takes the root "
        "of the sum of (G_a n_a)^2",
        dealii::Patterns::List(Double(), 0, 3, ","));
      declare("Critical stretch",
              properties.critical_stretch,
              "Stretch at which bonds break >= 0 [-]; 0: from the fracture energy");
      declare("Tensile strength",
              properties.tensile_strength,
              "Strength in uniaxial tension f_t >= 0 [Pa], of a Failure criterion, 0: unbreakable; or of a "
              "Softening, 0: none");
      declare(
        "Compressive strength",
        properties.compressive_strength,
        "Strength in uniaxial compression f_c >= f_t [Pa], of a Failure criterion that has both strengths");
    }

    void
    check_fracture_energies(const MaterialProperties &properties, const std::string &section, const int dim)
    {
      const std::vector<double> &energies = properties.fracture_energies;
      if (energies.empty())
        return;
      InputErrorCollector errors;
      if (energies.size() != static_cast<std::size_t>(dim) ||
          !std::all_of(energies.begin(), energies.end(), [](const double energy) { return energy > 0; }))
        errors.add(InputError("a fracture energy for each of the material's axes is needed")
                     .parameter(section + "/Fracture energies")
                     .allowed(std::to_string(dim) + " numbers > 0 [J/m^2]"));
      if (properties.fracture_energy > 0 || properties.critical_stretch > 0)
        errors.add(
          InputError("fracture energies by direction, and one for all are both given")
            .parameter(section + (properties.fracture_energy > 0 ? "/Fracture energy" : "/Critical stretch"))
            .hint("remove it, or Fracture energies"));
      errors.raise();
    }

    void check_properties(const MaterialProperties &properties,
                          const std::string        &section,
                          const PlaneAssumption     assumption,
                          const int                 dim)
    {
      InputErrorCollector errors;
      errors.collect([&] { properties.symmetry.check(!properties.fracture_energies.empty()); });
      errors.collect([&] { check_fracture_energies(properties, section, dim); });
      const bool is_isotropic = properties.symmetry.is_isotropic();
      if (is_isotropic && !(properties.young_modulus > 0))
        errors.add(InputError("Young's modulus must be positive")
                     .parameter(section + "/Young modulus")
                     .allowed("a number > 0"));
      if (is_isotropic && !(properties.poisson_ratio > -1 && properties.poisson_ratio < 0.5))
        errors.add(InputError("Poisson's ratio is outside the range of a stable elastic solid")
                     .parameter(section + "/Poisson ratio")
                     .allowed("-1 < nu < 0.5")
                     .hint(assumption == PlaneAssumption::plane_stress ?
                             "" :
                             "nu = 0.5 is incompressible: take a value such as 0.49"));
      if (!(properties.density > 0))
        errors.add(
          InputError("the density must be positive").parameter(section + "/Density").allowed("a number > 0"));
      if (!(properties.critical_stretch >= 0))
        errors.add(InputError("the critical stretch must not be negative")
                     .parameter(section + "/Critical stretch")
                     .allowed("a number >= 0"));
      if (properties.critical_stretch > 0 && properties.fracture_energy > 0)
        errors.add(InputError("fracture energy and critical stretch are both given")
                     .parameter(section + "/Critical stretch")
                     .hint("remove one of them: each follows from the other"));
      if (!(properties.fracture_energy >= 0))
        errors.add(InputError("the fracture energy must not be negative")
                     .parameter(section + "/Fracture energy")
                     .allowed("a number >= 0"));
      if (!(properties.tensile_strength >= 0))
        errors.add(InputError("the tensile strength must not be negative")
                     .parameter(section + "/Tensile strength")
                     .allowed("a number >= 0"));
      if (!(properties.compressive_strength >= 0))
        errors.add(InputError("the compressive strength must not be negative")
                     .parameter(section + "/Compressive strength")
                     .allowed("a number >= 0, the size of the stress"));
      errors.raise();
    }
  } // namespace

  double MaterialProperties::mean_fracture_energy() const
  {
    const auto &each = fracture_energies;
    return each.empty() ? fracture_energy : std::accumulate(each.begin(), each.end(), 0.) / each.size();
  }

  template <int dim>
  dealii::SymmetricTensor<2, dim> MaterialProperties::fracture_energy_by_normal() const
  {
    dealii::SymmetricTensor<2, dim> result = fracture_energy * dealii::unit_symmetric_tensor<dim>();
    if (fracture_energies.empty())
      return result;
    const dealii::Tensor<2, 3> rotation = symmetry.rotation<dim>();
    for (int a = 0; a < dim; ++a)
      for (int b = a; b < dim; ++b)
        {
          result[a][b] = 0.;
          for (int axis = 0; axis < dim; ++axis)
            result[a][b] += rotation[a][axis] * fracture_energies[axis] * rotation[b][axis];
        }
    return result;
  }

  template dealii::SymmetricTensor<2, 2> MaterialProperties::fracture_energy_by_normal() const;
  template dealii::SymmetricTensor<2, 3> MaterialProperties::fracture_energy_by_normal() const;

  bool MaterialParameters::has_fracture_energies() const
  {
    return !body.fracture_energies.empty() ||
           std::any_of(groups.begin(), groups.end(), [](const auto &group) {
             return !group.second.fracture_energies.empty();
           });
  }

  void MaterialParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Material");
    prm.add_parameter("Assumption", assumption, "How a 2-D body stands in space; without meaning in 3-D");
    prm.add_parameter(
      "Failure criterion",
      failure_criterion,
      "By which stress bonds of Model = correspondence break, the mean of that at their ends; with "
      "Softening, where the bonds of a node begin to soften, of Form = consistent, which takes Fracture "
      "energy to the end: " +
        meanings_of<StressCriterionTraits>() +
        ". Principal stresses are those in space. Without it bonds break by stretch");
    prm.add_parameter(
      "Softening",
      softening,
      "How the force of bonds falls as they open, with the fracture energy for the "
      "area below: " +
        meanings_of<SofteningTraits>() +
        ". Cracks of bonds that break at once grow late. With Tensile strength softening begins where the "
        "bonds of a family bear it together, or where a Failure criterion says so; without, at 0.71 times "
        "the critical stretch of bonds that break at once");
    declare_properties(prm, body, file, "Material");
    for (const std::string &group : file.subsections("Material"))
      {
        prm.enter_subsection(group);
        declare_properties(prm, groups[group], file, "Material/" + group);
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  void MaterialParameters::check(const int dim) const
  {
    InputErrorCollector errors;
    const auto          check = [&](const MaterialProperties &material, const std::string &section) {
      errors.collect([&] { check_properties(material, section, assumption, dim); });
      errors.collect([&] { check_strengths(material, section); });
      errors.collect([&] {
        if (dim == 2)
          elastic_solid<2>(material);
        else
          elastic_solid<3>(material);
      });
    };
    check(body, "Material");
    bool has_strength = body.tensile_strength > 0;
    for (const auto &group : groups)
      {
        check(group.second, "Material/" + group.first);
        has_strength = has_strength || group.second.tensile_strength > 0;
      }
    if (has_criterion() && !has_strength)
      errors.add(InputError("no material has the strength that this criterion holds stresses against")
                   .parameter("Material/Failure criterion")
                   .allowed("none without Material/Tensile strength"));
    errors.raise();
  }

  void MaterialParameters::check_strengths(const MaterialProperties &material,
                                           const std::string        &section) const
  {
    InputErrorCollector errors;
    const bool          has_tensile_strength = material.tensile_strength > 0 && !softens();
    if (!has_criterion() && (has_tensile_strength || material.compressive_strength > 0))
      errors.add(
        InputError("a strength is given, and nothing breaks by stress")
          .parameter(section + (has_tensile_strength ? "/Tensile strength" : "/Compressive strength"))
          .hint("set Material/Failure criterion, or Softening, or remove it"));
    const bool has_energy = material.mean_fracture_energy() > 0;
    if (has_criterion() && (material.critical_stretch > 0 || (has_energy && !softens())))
      errors.add(InputError("bonds break either by stress or by stretch")
                   .parameter(section + (material.critical_stretch > 0 ? "/Critical stretch" :
                                         material.fracture_energy > 0  ? "/Fracture energy" :
                                                                         "/Fracture energies"))
                   .allowed("0 for Failure criterion = " + name_of(failure_criterion))
                   .hint("a stress may begin what a fracture energy ends: set Material/Softening"));
    if (has_criterion() && softens() && has_energy != (material.tensile_strength > 0))
      errors.add(InputError("a stress begins to soften bonds, and a fracture energy ends it: both are needed")
                   .parameter(section + (has_energy ? "/Tensile strength" : "/Fracture energy"))
                   .allowed("a number > 0 for Failure criterion = " + name_of(failure_criterion) +
                            " with Softening = " + name_of(softening)));
    // Weaker in compression, sin(phi) = (f_c - f_t)/(f_c + f_t) would be negative.
    if (failure_criterion->has_compressive_strength && material.tensile_strength > 0 &&
        !(material.compressive_strength >= material.tensile_strength))
      errors.add(
        InputError("the angle of internal friction follows from both strengths, and would be negative")
          .parameter(section + "/Compressive strength")
          .allowed("a number >= Tensile strength for Failure criterion = " + name_of(failure_criterion)));
    errors.raise();
  }

  template <int dim>
  ElasticSolid<dim> MaterialParameters::elastic_solid(const MaterialProperties &material) const
  {
    const PlaneAssumption own = dim == 3 ? PlaneAssumption::solid : assumption;
    if (material.symmetry.is_isotropic())
      return ElasticConstants{material.young_modulus, material.poisson_ratio, own};
    return make_solid<dim>(material.symmetry, own);
  }

  template ElasticSolid<2> MaterialParameters::elastic_solid(const MaterialProperties &) const;
  template ElasticSolid<3> MaterialParameters::elastic_solid(const MaterialProperties &) const;
} // namespace perideal
