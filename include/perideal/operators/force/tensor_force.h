// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_tensor_force_h
#define perideal_operators_force_tensor_force_h

#include <perideal/operators/force/breaking_bonds.h>
#include <perideal/operators/weights/tensor_weights.h>

#include <vector>

namespace perideal
{
  /**
   * Computes the force of bonds with tensors for stiffness, TIPD (14), (37): linear in the displacement, F =
   * tensor (u_j - u_i), in bonds that break at a stretch of the deformed bond, (|y_j - y_i| - |xi|)/|xi|.
   * Small rotations only: large ones strain the bonds. Tensors are kept in single precision, as FamilyForce
   * keeps its weights.
   */
  template <int dim>
  class TensorForce : public BreakingBonds<dim>
  {
  public:
    explicit TensorForce(const TensorWeights<dim> &weights);

    /// Not for this model: its families have no multipliers.
    void reweigh_as_bonds_break(const std::shared_ptr<const BondWeights<dim>> &,
                                const typename BondForce<dim>::Reweigh &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }
    void                compute(NodalVector &force, const NodalVector &displacement) override;
    void                visit_bond_forces(const typename BondForce<dim>::VisitBond &visit) const override;
    double              strain_energy() const override;
    double              released_energy(const NodalVector &velocity, const double time_step) const override;
    std::vector<double> dilatation() const override { return std::vector<double>(families->n_owned(), 0.); }
    std::size_t         memory_consumption() const override;

  private:
    using BreakingBonds<dim>::families;
    using BreakingBonds<dim>::bonds;
    using BreakingBonds<dim>::rest_length;
    using BreakingBonds<dim>::critical_stretch;
    using BreakingBonds<dim>::regions;
    using BreakingBonds<dim>::position;
    using BreakingBonds<dim>::forces;
    using BreakingBonds<dim>::softening;

    /// A bond that broke or softened in the last compute(), with the tensor it lost.
    struct BrokenBond
    {
      LocalIndex                      near, far;
      dealii::SymmetricTensor<2, dim> tensor;
    };

    bool carries_force(const BondIndex slot) const override;
    void clear_weights(const BondIndex slot) override;

    template <bool can_break>
    void sum_forces();
    /// Breaks or softens those of a group of bonds that are too long.
    /// @param margin of their lengths below the largest ones [m]
    void break_bonds(const LocalIndex i, const BondIndex first_slot, const Lanes &margin);

    /// The tensor as it is [N/m].
    dealii::SymmetricTensor<2, dim> tensor(const BondIndex slot) const { return unit * tensors.at(slot); }

    /// Adds what bonds of a group that softened, and are pressed together, resist their shortening by.
    /// @param loose what they have lost of themselves
    /// @param longer than at rest [m]
    void
    press_together(const LocalIndex i, const BondIndex first_slot, const Lanes &loose, const Lanes &longer);
    /// How a whole bond resists its shortening, along itself: nothing of one that is stretched.
    struct Pressed
    {
      dealii::Tensor<1, dim> force;
      double                 energy = 0;
    };
    Pressed pressed(const BondIndex slot, const LocalIndex i, const LocalIndex j) const;

    /// u_j - u_i.
    dealii::Tensor<1, dim> eta(const LocalIndex i, const LocalIndex j) const;

    /// Over the largest of their components, so that rounding is the same in all units, and that [N/m].
    BondTensors<float, dim>           tensors;
    double                            unit;
    dealii::AlignedVector<NodeRecord> displacements;
    std::vector<BrokenBond>           broken_now;
  };
} // namespace perideal

#endif
