// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_elastic_symmetry_h
#define perideal_parameters_elastic_symmetry_h

#include <perideal/base/exceptions.h>
#include <perideal/parameters/choice.h>
#include <perideal/parameters/elastic_solid.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace perideal
{
  class ParameterFile;

  /// What a material looks like turned.
  enum class SymmetryName
  {
    isotropic,
    cubic,
    transversely_isotropic,
    orthotropic,
    anisotropic
  };

  template <>
  struct ChoiceNames<SymmetryName>
  {
    static constexpr const char *list[] = {
      "isotropic", "cubic", "transversely isotropic", "orthotropic", "anisotropic"};
  };

  /// The elastic symmetry of a material and its constants in the material's own axes 1, 2, 3; those of an
  /// isotropic one are not here.
  struct ElasticSymmetry
  {
    SymmetryName name = SymmetryName::isotropic;
    /// Moduli [Pa] and Poisson's ratios of the engineering constants, as many as the symmetry has.
    std::vector<double> young_moduli, poisson_ratios, shear_moduli;
    /// Upper triangle of the stiffness [Pa], row by row.
    std::vector<double> stiffness;
    /// Pairs of indices that the rows of a stiffness of 21 numbers stand for.
    std::string voigt_order = "11 22 33 23 13 12";
    /// How the material's axes stand in the body [degrees]: none, an angle about z, or three Euler angles.
    std::vector<double> orientation;

    /// Section of the material, "Material" or "Material/GROUP".
    std::string section = "Material";
    /// Names of the parameters that this section gives itself, rather than inherits.
    std::vector<std::string> given;

    bool is_isotropic() const { return name == SymmetryName::isotropic; }

    /// Declares the parameters in the section that is open, @p section of the file.
    void declare(dealii::ParameterHandler &prm, const ParameterFile &file, const std::string &section);

    /// @param has_axes whether something but the stiffness has the material's axes
    /// @throws InputError when the section gives a parameter that its symmetry has no use for.
    void check(const bool has_axes = false) const;

    /// Returns the rotation from the material's axes to those of the body.
    /// @throws InputError when the orientation has another number of angles than @p dim allows.
    template <int dim>
    dealii::Tensor<2, 3> rotation() const;

    /// An error about a list of constants, which it names with its values.
    InputError complaint(const std::string         &problem,
                         const std::string         &parameter,
                         const std::vector<double> &values) const;
  };

  /// The solid of a symmetry other than isotropic, with its axes turned.
  /// @throws InputError when constants are missing, too many, or those of no elastic solid.
  template <int dim>
  ElasticSolid<dim> make_solid(const ElasticSymmetry &symmetry, const PlaneAssumption assumption);
} // namespace perideal

#endif
