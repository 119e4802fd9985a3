// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/input_errors.h>
#include <perideal/parameters/elastic_symmetry.h>
#include <perideal/parameters/inherited_parameter.h>
#include <perideal/parameters/parameter_file.h>

#include <algorithm>
#include <sstream>

namespace perideal
{
  void ElasticSymmetry::declare(dealii::ParameterHandler &prm,
                                const ParameterFile      &file,
                                const std::string        &of_section)
  {
    using namespace dealii::Patterns;
    section               = of_section;
    const auto is_default = [&](const std::string &parameter, const std::string &value) {
      return value.empty() || (parameter == "Voigt order" && value == voigt_order);
    };
    for (const char *parameter : {"Young modulus",
                                  "Poisson ratio",
                                  "Young moduli",
                                  "Poisson ratios",
                                  "Shear moduli",
                                  "Stiffness",
                                  "Voigt order",
                                  "Orientation"})
      if (!is_default(parameter, file.value_of(section + "/" + parameter, "")))
        given.push_back(parameter);

    const auto declare =
      [&](const char *parameter, auto &value, const std::string &meaning, const PatternBase &pattern) {
        declare_inherited(prm, file, section, parameter, value, meaning, pattern);
      };
    const List numbers(Double(), 0, List::max_int_value, ",");
    declare(
      "Symmetry",
      name,
      "Elastic symmetry. isotropic: from Young modulus and Poisson ratio. cubic, transversely isotropic "
      "(about axis 1, the fibre), orthotropic: from Young moduli, Poisson ratios and Shear moduli. "
      "anisotropic: from Stiffness",
      *Tools::Convert<SymmetryName>::to_pattern());
    declare(
      "Young moduli",
      young_moduli,
      "Young's moduli > 0 [Pa] in the material's own axes 1, 2, 3. cubic: E; transversely isotropic: E1, "
      "E2; orthotropic: E1, E2, E3. Plane stress may leave out the constants across the plane "
      "(orthotropic: E1, E2; nu12; G12; transversely isotropic: E1, E2; nu12; G12): stretches are then "
      "not coupled across it, and the strain zz, which is not known, is given as 0",
      numbers);
    declare("Poisson ratios",
            poisson_ratios,
            "Poisson's ratios [-]; nu_ij is minus the strain along j over that along i in a pull along i, so "
            "that nu_ij/E_i = nu_ji/E_j. cubic: nu; transversely isotropic: nu12, nu23; orthotropic: nu12, "
            "nu13, nu23",
            numbers);
    declare("Shear moduli",
            shear_moduli,
            "Shear moduli > 0 [Pa]. cubic: G; transversely isotropic: G12; orthotropic: G12, G13, G23",
            numbers);
    declare(
      "Stiffness",
      stiffness,
      "All constants [Pa] of symmetry anisotropic: the upper triangle of the stiffness matrix, row by "
      "row, 21 numbers; in 2-D also 6 numbers, which are already those of the plane (Q11, Q12, Q16, Q22, "
      "Q26, Q66)",
      numbers);
    declare("Voigt order",
            voigt_order,
            "Stresses that the rows of a Stiffness of 21 numbers stand for",
            Selection("11 22 33 23 13 12|11 22 33 12 13 23|11 22 33 12 23 13"));
    declare(
      "Orientation",
      orientation,
      "How the material's axes stand in the body [degrees]. One number: angle from x to axis 1, about z "
      "(the fibre angle); three (3-D): Euler angles about z, then the new x, then the new z; none: the "
      "body's axes",
      numbers);
  }

  void ElasticSymmetry::check(const bool has_axes) const
  {
    std::vector<std::string> used = {"Young moduli", "Poisson ratios", "Shear moduli", "Orientation"};
    if (is_isotropic())
      {
        used = {"Young modulus", "Poisson ratio"};
        if (has_axes)
          used.push_back("Orientation");
      }
    else if (name == SymmetryName::anisotropic)
      {
        used = {"Stiffness", "Orientation"};
        if (stiffness.size() != 6)
          used.push_back("Voigt order");
      }
    InputErrorCollector errors;
    for (const std::string &parameter : given)
      if (std::find(used.begin(), used.end(), parameter) == used.end())
        errors.add(InputError("the " + name_of(name) + " symmetry has no use for this")
                     .parameter(section + "/" + parameter)
                     .hint(parameter == "Voigt order" ?
                             "it says what the rows of a Stiffness of 21 numbers stand for" :
                             "remove it, or choose another " + section + "/Symmetry"));
    errors.raise();
  }

  InputError ElasticSymmetry::complaint(const std::string         &problem,
                                        const std::string         &parameter,
                                        const std::vector<double> &values) const
  {
    InputError result(problem);
    result.parameter(section + "/" + parameter);
    // What the section gives itself is added as the user wrote it, with its line.
    if (std::find(given.begin(), given.end(), parameter) == given.end())
      {
        std::ostringstream text;
        for (const double value : values)
          text << (text.tellp() > 0 ? ", " : "") << value;
        result.given(values.empty() ? "nothing" : text.str());
      }
    return result;
  }
} // namespace perideal
