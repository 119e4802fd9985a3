// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_elastic_solid_h
#define perideal_parameters_elastic_solid_h

#include <perideal/parameters/elastic_constants.h>

#include <deal.II/base/symmetric_tensor.h>

#include <vector>

namespace perideal
{
  /**
   * A linear elastic material of any symmetry, sigma_ij = C_ijkl eps_kl, in the problem's own
   * dimension: of a two-dimensional body C is what the plane assumption leaves of the solid's.
   */
  template <int dim>
  class ElasticSolid
  {
  public:
    ElasticSolid() = default;

    /// An isotropic solid.
    ElasticSolid(const ElasticConstants &constants);

    /// Any solid, by its stiffness in space [Pa], which is reduced to the plane in 2-D: plane strain
    /// takes the entries in the plane, plane stress takes out the three stresses across it.
    ElasticSolid(const dealii::SymmetricTensor<4, 3> &in_space, const PlaneAssumption assumption);

    /// C [Pa], in the problem's own dimension.
    const dealii::SymmetricTensor<4, dim> &stiffness() const { return tensor; }

    /// C of the solid in space [Pa].
    const dealii::SymmetricTensor<4, 3> &stiffness_in_space() const { return solid; }

    /// The strain in space under a strain of the problem's own dimension: of a two-dimensional body with
    /// the components across it, which vanish in plane strain and leave no stress in plane stress.
    dealii::SymmetricTensor<2, 3> strain_in_space(const dealii::SymmetricTensor<2, dim> &strain) const;

    /// The strain in space that has to be taken back where the body would expand freely by 1 in all
    /// directions and its strain in the problem's own dimension is held at zero: 1 in all directions, in
    /// plane stress with what leaves no stress across.
    dealii::SymmetricTensor<2, 3> expansion_in_space() const;

    /// The stress in the problem's own dimension that holds such an expansion back [Pa]: at a strain eps and
    /// a free expansion e the stress is C eps less e times this.
    dealii::SymmetricTensor<2, dim> stress_of_expansion() const;

    /// Twice the energy that is stored then, in a unit of volume [J/m^3]: at eps and e the energy is half of
    /// eps:C:eps less twice e eps:stress_of_expansion(), and e^2 times this.
    double energy_of_expansion() const { return expansion_in_space() * (solid * expansion_in_space()); }

    bool is_isotropic() const { return has_no_direction; }

    /// The constants; of an anisotropic solid those of the isotropic one that is nearest in the sense of
    /// Voigt's mean: equal stress traces under expansion and equal mean of the deviatoric stiffness.
    const ElasticConstants &isotropic() const { return constants; }

    PlaneAssumption assumption() const { return constants.assumption; }

  private:
    ElasticConstants                constants;
    dealii::SymmetricTensor<4, 3>   solid;
    dealii::SymmetricTensor<4, dim> tensor;
    bool                            has_no_direction = true;
  };

  /// A solid of a stiffness in the problem's own dimension [Pa]; one of a plane body is that of plane strain.
  template <int dim>
  ElasticSolid<dim> elastic_solid(const dealii::SymmetricTensor<4, dim> &stiffness);

  /// Eigenvalues, in ascending order, of a symmetric tensor of rank four as a map of symmetric tensors,
  /// which are those of its matrix in Kelvin-Mandel form.
  template <int dim>
  std::vector<double> kelvin_eigenvalues(const dealii::SymmetricTensor<4, dim> &tensor);

  /// The smallest eigenvalue of C [Pa] in the problem's own dimension; not positive: some strain costs no
  /// work.
  template <int dim>
  double smallest_stiffness(const ElasticSolid<dim> &solid)
  {
    return kelvin_eigenvalues(solid.stiffness()).front();
  }
} // namespace perideal

#endif
