// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_hyperelastic_law_h
#define perideal_parameters_hyperelastic_law_h

#include <perideal/parameters/elastic_solid.h>
#include <perideal/parameters/listed.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <map>
#include <memory>
#include <string>
#include <tuple>
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

    /// dS/dE of the second Piola-Kirchhoff stress with Green's strain [Pa], where it is the same at every
    /// strain; else null.
    virtual const dealii::SymmetricTensor<4, dim> *constant_modulus() const { return nullptr; }
  };

  /// Laws by material id.
  template <int dim>
  using LawsByMaterial = std::map<dealii::types::material_id, std::shared_ptr<const HyperelasticLaw<dim>>>;

  template <int dim>
  using CreateLaw = std::shared_ptr<const HyperelasticLaw<dim>> (*)(const ElasticSolid<dim> &solid);

  /// What a law says of itself, in its own file.
  struct LawTraits
  {
    /// Name, and for lists of parameters the rest of "NAME: ...".
    std::string name, meaning;
    /// Solids without isotropy are welcome.
    bool takes_any_symmetry = false;
    /// The tangent is that at rest, and strains are small.
    bool is_linear = false;
    /// Creates it in 2-D and 3-D.
    std::tuple<CreateLaw<2>, CreateLaw<3>> create = {};
  };

  using LawChoice = Listed<LawTraits>;
  /// @cond
  template <>
  const Registry<LawTraits> &LawChoice::list();
  /// @endcond

  /// @throws InputError on a solid that the law does not take.
  template <int dim>
  std::shared_ptr<const HyperelasticLaw<dim>> create_law(const LawChoice         &law,
                                                         const ElasticSolid<dim> &solid);
} // namespace perideal

#endif
