// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_correspondence_tangent_h
#define perideal_operators_linear_correspondence_tangent_h

#include <perideal/operators/force/correspondence_force.h>
#include <perideal/operators/linear/tangent_operator.h>

#include <array>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Applies the derivative of CorrespondenceForce, with the sign of a resisting force: the Hessian of the
   * energy of CorrespondenceRows with dP/dF of the law at each node. Until something was linearised it is
   * that of the body at rest, which is linear elasticity whatever the law.
   */
  template <int dim>
  class CorrespondenceTangent : public TangentOperator<dim>
  {
  public:
    CorrespondenceTangent(const std::shared_ptr<const Families<dim>>           &families,
                          const std::shared_ptr<const CorrespondenceRows<dim>> &rows,
                          const LawsByMaterial<dim>                            &laws);

    /// From now on internal_force() takes strains as what is above a free expansion, the mean of each cell as
    /// it is then.
    void set_expansion(const SolidOf<dim>                              &solid_of,
                       const std::shared_ptr<const CellExpansion<dim>> &of_cells);

    /// @param force a CorrespondenceForce of the same rows
    void linearise(const BondForce<dim> &force, const Slope slope = Slope::tangent) override;

    void   vmult(NodalVector &force, const NodalVector &displacement) const override;
    void   internal_force(NodalVector &force, const NodalVector &displacement) const override;
    double energy_of_expansion() const override { return expansion.energy; }
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    void        assemble(const typename BondOperator<dim>::AddBlock &add) const override;
    bool        is_symmetric() const override { return true; }
    std::size_t memory_consumption() const override;

    /// Trace of the gradient of the last vmult(), by owned node.
    std::vector<double> dilatation() const override;

  private:
    using Moduli = std::array<double, dim * dim * dim * dim>;

    static Moduli          flat(const dealii::Tensor<4, dim> &tangent);
    dealii::Tensor<4, dim> tangent_of(const LocalIndex i) const;
    dealii::Tensor<2, dim> stress(const LocalIndex i, const dealii::Tensor<2, dim> &gradient) const;

    std::shared_ptr<const CorrespondenceRows<dim>> rows;
    /// dP/dF [Pa]: by material where laws are linear or the body at rest, else by node.
    std::vector<Moduli>     moduli;
    std::vector<LocalIndex> moduli_of;
    bool                    is_linear;

    struct Expansion
    {
      /// By owned node: the stress of a free expansion of 1 that is held [Pa], and twice its energy [J/m^3].
      std::vector<dealii::SymmetricTensor<2, dim>> stress;
      std::vector<double>                          work;
      /// Null: cells expand by nothing.
      std::shared_ptr<const CellExpansion<dim>> of_cells = nullptr;
      /// energy_of_expansion() of the last internal_force().
      double energy = 0;
    };
    std::shared_ptr<const Families<dim>> families;
    mutable Expansion                    expansion;
  };
} // namespace perideal

#endif
