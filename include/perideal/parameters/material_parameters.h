// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_material_parameters_h
#define perideal_parameters_material_parameters_h

#include <perideal/parameters/elastic_solid.h>
#include <perideal/parameters/elastic_symmetry.h>
#include <perideal/parameters/softening.h>
#include <perideal/parameters/stress_criteria.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>

namespace perideal
{
  class ParameterFile;

  /// What one material is made of.
  struct MaterialProperties
  {
    /// Symmetry, and the constants of all but isotropic materials.
    ElasticSymmetry symmetry;
    /// Young's modulus [Pa] of an isotropic material.
    double young_modulus = 70e9;
    /// Poisson's ratio [-] of an isotropic material.
    double poisson_ratio = 0.33;
    /// Mass density [kg/m^3].
    double density = 2700.;
    /// Coefficient of thermal expansion [1/K].
    double thermal_expansion = 0.;
    /// Fracture energy [J/m^2] of cracks in all directions; 0: the material does not break, or as the next
    /// says.
    double fracture_energy = 0.;
    /// Those of cracks normal to the material's axes 1, 2 (, 3) [J/m^2]; none: one for all.
    std::vector<double> fracture_energies;
    /// Stretch at which bonds break [-]; 0: from the fracture energy.
    double critical_stretch = 0.;
    /// Strengths in uniaxial tension and compression [Pa]. No tensile strength: the material does not break
    /// by stress, and softening bonds begin where they follow the mesh least.
    double tensile_strength = 0., compressive_strength = 0.;

    /// Returns the fracture energy, the mean of those of the axes [J/m^2].
    double mean_fracture_energy() const;

    /// Returns G of the fracture energy |G n| of cracks of a normal n [J/m^2], in the body's axes.
    template <int dim>
    dealii::SymmetricTensor<2, dim> fracture_energy_by_normal() const;
  };

  /**
   * Section "Material": the properties of the whole body, and subsections named
   * like a physical group for the cells of that group. A subsection's value
   * defaults to the one of the section.
   */
  struct MaterialParameters
  {
    /// Of interest in 2-D only.
    PlaneAssumption assumption = PlaneAssumption::plane_stress;
    /// By which stress bonds break.
    FailureCriterion failure_criterion = "none";
    /// How bonds that break by stretch lose their force.
    Softening softening = "none";
    /// Properties of cells in no named group.
    MaterialProperties body;
    /// Whether the scene gives the constants of the body; they may be those of named groups only.
    bool body_is_given = true;
    /// Properties by physical group name (or id).
    std::map<std::string, MaterialProperties> groups;

    /// Declares the section, with a subsection for each the file has.
    void declare(dealii::ParameterHandler &prm, const ParameterFile &file);

    /// @throws InputError on values outside the physical range in @p dim dimensions, and on
    ///   constants that are missing, too many or of no use.
    void check(const int dim) const;

    /// Whether bonds break by stress.
    bool has_criterion() const { return failure_criterion->utilisation != nullptr; }

    /// Whether a material has fracture energies by direction.
    bool has_fracture_energies() const;

    /// Whether bonds that break by stretch soften first.
    bool softens() const { return !softening->curve.empty(); }

    /// What a material is in @p dim dimensions.
    /// @throws InputError as check().
    template <int dim>
    ElasticSolid<dim> elastic_solid(const MaterialProperties &material) const;

  private:
    /// @throws InputError on strengths that the criterion cannot be made of.
    void check_strengths(const MaterialProperties &material, const std::string &section) const;
  };
} // namespace perideal

#endif
