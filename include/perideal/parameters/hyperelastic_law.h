// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_hyperelastic_law_h
#define perideal_parameters_hyperelastic_law_h

#include <perideal/parameters/elastic_solid.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * The stress of a material at finite strain, by the energy W of a unit of the undeformed volume. All take
   * the displacement gradient H = F - I in the problem's own dimension; what the plane assumption says of
   * the direction across is the law's to find.
   *
   * Models ask once a node or point, and keep what bonds need of it.
   */
  template <int dim>
  class HyperelasticLaw
  {
  public:
    virtual ~HyperelasticLaw() = default;

    /// W [J/m^3]; infinite where the law admits no such deformation.
    virtual double energy(const dealii::Tensor<2, dim> &H) const = 0;

    /// P = dW/dF, the first Piola-Kirchhoff stress [Pa]; NaN where the law admits no such deformation.
    virtual dealii::Tensor<2, dim> stress(const dealii::Tensor<2, dim> &H) const = 0;

    /// dP_iJ/dF_kL [Pa].
    virtual dealii::Tensor<4, dim> tangent(const dealii::Tensor<2, dim> &H) const = 0;

    /// The Cauchy stress in space [Pa], with the one across a plane body; the stress itself where strains
    /// are small.
    virtual dealii::SymmetricTensor<2, 3> cauchy_stress(const dealii::Tensor<2, dim> &H) const = 0;

    /// The stretch across a body in plane stress [-], else 1; 0 where the law leaves it no thickness.
    virtual double thickness_stretch(const dealii::Tensor<2, dim> &H) const = 0;

    /// Whether the tangent is that at rest, whatever the deformation.
    virtual bool is_linear() const { return false; }
  };

  /// Laws by material id.
  template <int dim>
  using LawsByMaterial = std::map<dealii::types::material_id, std::shared_ptr<const HyperelasticLaw<dim>>>;

  /// The laws that there are: linear elastic, Saint Venant-Kirchhoff, neo-Hookean.
  std::vector<std::string> law_names();

  /// Whether a law of that name takes solids without isotropy.
  bool takes_any_symmetry(const std::string &law);

  /// @throws InputError on an unknown name, or a solid that the law does not take.
  template <int dim>
  std::shared_ptr<const HyperelasticLaw<dim>> create_law(const std::string       &name,
                                                         const ElasticSolid<dim> &solid);
} // namespace perideal

#endif
