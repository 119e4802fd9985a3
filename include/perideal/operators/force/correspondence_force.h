// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_correspondence_force_h
#define perideal_operators_force_correspondence_force_h

#include <perideal/operators/force/breaking_bonds.h>
#include <perideal/operators/force/continuum_force.h>
#include <perideal/operators/weights/correspondence_rows.h>
#include <perideal/operators/weights/laws_of_nodes.h>

#include <deal.II/base/symmetric_tensor.h>

#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Computes the force of the correspondence model in the deformed body, - dU/du of CorrespondenceRows. Bonds
   * break by stress: that of a bond is the mean of the Cauchy stresses at its ends (VNOSB 16). Of the bonds
   * beyond their strength those break at once that are within a tenth of the farthest: what the others bear,
   * the new crack may relieve them of.
   *
   * A family that has lost bonds has the gradient of the remaining ones (20). Where these no longer span
   * space, the node bears no stress of its own, and only the penalty of its neighbours connects it with the
   * body.
   */
  template <int dim>
  class CorrespondenceForce : public BreakingBonds<dim>, public ContinuumForce<dim>
  {
  public:
    CorrespondenceForce(const std::shared_ptr<const Families<dim>>     &families,
                        const std::shared_ptr<CorrespondenceRows<dim>> &rows,
                        const LawsByMaterial<dim>                      &laws);

    /// Share of its strength that a stress in space [Pa] takes of a material [-]; it breaks at 1.
    using Utilisation =
      std::function<double(const dealii::types::material_id, const dealii::SymmetricTensor<2, 3> &)>;

    /// Makes bonds break by stress from now on.
    /// @param can_break of two local nodes
    void set_strength(const Utilisation                                             &utilisation,
                      const std::function<bool(const LocalIndex, const LocalIndex)> &can_break);

    /// Not for this model: its families are weighed anew by themselves.
    void reweigh_as_bonds_break(const std::shared_ptr<const BondWeights<dim>> &,
                                const typename BondForce<dim>::Reweigh &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    void                compute(NodalVector &force, const NodalVector &displacement) override;
    double              strain_energy() const override;
    double              released_energy(const NodalVector &velocity, const double time_step) const override;
    std::vector<double> dilatation() const override;
    std::vector<double> utilisation() const override;
    std::size_t         memory_consumption() const override;

    /// Not for this model: bonds carry the stresses of whole families.
    void visit_bond_forces(const typename BondForce<dim>::VisitBond &) const override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    std::vector<dealii::Tensor<2, dim>> gradients() const override;
    ExpandedLaw<dim>                    law(const LocalIndex i) const override { return laws.mean(i); }

    /// From now on nodes expand freely by the mean of their cells.
    /// @param laws_in_space of materials in plane strain
    void expand(const LawsByMaterial<3>                         &laws_in_space,
                const std::shared_ptr<const CellExpansion<dim>> &of_cells)
    {
      laws.expand(*families, laws_in_space, of_cells);
    }

    /// Nodes of all ranks whose bonds span no space any more. Collective.
    GlobalIndex n_without_gradient() const;

  private:
    using BreakingBonds<dim>::families;
    using BreakingBonds<dim>::bonds;
    using BreakingBonds<dim>::critical_stretch;

    bool carries_force(const BondIndex slot) const override { return !is_gone[slot]; }
    void clear_weights(const BondIndex slot) override;

    /// Weighs the families that lost bonds since the last time.
    void update_rows();
    /// Breaks the bonds beyond their strength. Collective.
    void break_bonds();
    /// Utilisation of the bonds by slot; zero of those that cannot break. Collective.
    std::vector<double> utilisation_of_bonds() const;
    double              energy_of(const std::vector<LocalIndex> &nodes) const;

    std::shared_ptr<CorrespondenceRows<dim>> rows;
    LawsOfNodes<dim>                         laws;
    Utilisation                              of_stress;
    std::vector<bool>                        is_gone;
    /// Owned nodes whose families lost bonds.
    std::vector<LocalIndex> changed;

    NodalVector last;
    double      released = 0;
  };
} // namespace perideal

#endif
