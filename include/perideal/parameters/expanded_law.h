// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_expanded_law_h
#define perideal_parameters_expanded_law_h

#include <perideal/parameters/hyperelastic_law.h>

namespace perideal
{
  /**
   * A law of a material that would expand freely by e in all directions. Of small strains the law takes
   * H - e I; else F is the product of an elastic part F_e = F/s and of the expansion s I, s = 1 + e, and
   *
   *     W(F) = s^3 W_e(F_e),    P = s^2 P_e(F_e),    dP/dF = s dP_e/dF_e
   *
   * in a unit of the volume before it expands. In plane strain the elastic part is pressed across, which only
   * the law in space knows; in plane stress the body expands across as well.
   */
  template <int dim>
  class ExpandedLaw : public HyperelasticLaw<dim>
  {
  public:
    /// @param law must outlive this one
    /// @param in_space the same law in space, which must outlive this one, of bodies in plane strain; else
    /// null
    explicit ExpandedLaw(const HyperelasticLaw<dim> &law,
                         const double                expansion = 0.,
                         const HyperelasticLaw<3>   *in_space  = nullptr);

    double                                 energy(const dealii::Tensor<2, dim> &H) const override;
    dealii::Tensor<2, dim>                 stress(const dealii::Tensor<2, dim> &H) const override;
    dealii::Tensor<4, dim>                 tangent(const dealii::Tensor<2, dim> &H) const override;
    dealii::SymmetricTensor<2, 3>          cauchy_stress(const dealii::Tensor<2, dim> &H) const override;
    double                                 thickness_stretch(const dealii::Tensor<2, dim> &H) const override;
    bool                                   is_linear() const override { return law.is_linear(); }
    const dealii::SymmetricTensor<4, dim> *constant_modulus() const override
    {
      return expansion == 0. ? law.constant_modulus() : nullptr;
    }

  private:
    /// H of the elastic part.
    template <int d>
    dealii::Tensor<2, d> elastic(const dealii::Tensor<2, d> &H) const;
    /// s to a power, of small strains 1.
    double scale(const int power) const;

    const HyperelasticLaw<dim> &law;
    const HyperelasticLaw<3>   *in_space;
    double                      expansion;
  };

  /// The laws in space of solids in plane strain, by material id; none for other bodies.
  /// @throws InputError on a solid that the law does not take.
  template <int dim>
  LawsByMaterial<3> laws_in_space(const LawChoice                                               &law,
                                  const std::map<dealii::types::material_id, ElasticSolid<dim>> &solids);
} // namespace perideal

#endif
