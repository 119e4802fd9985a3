// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_wrapped_bonds_h
#define perideal_operators_force_wrapped_bonds_h

#include <perideal/operators/force/bond_force.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// Has the bonds of another force, to which a derived class adds what is not one of bonds.
  template <int dim>
  class WrappedBonds : public BondForce<dim>
  {
  public:
    void set_critical_stretch(const typename BondForce<dim>::CriticalStretch &stretch,
                              const SofteningLaw                             &law     = SofteningLaw(),
                              const typename BondForce<dim>::CriticalStretch &first   = {},
                              const UnknownLimits::Source                    &unknown = {}) override
    {
      bonds->set_critical_stretch(stretch, law, first, unknown);
    }
    const SofteningBonds &softening_bonds() const override { return bonds->softening_bonds(); }
    void                  judge_bonds(const Judgement judgement) override { bonds->judge_bonds(judgement); }
    void                  reweigh_as_bonds_break(const std::shared_ptr<const BondWeights<dim>> &weights,
                                                 const typename BondForce<dim>::Reweigh        &reweigh) override
    {
      bonds->reweigh_as_bonds_break(weights, reweigh);
    }
    GlobalIndex cut(const BondPredicate<dim> &is_cut) override { return bonds->cut(is_cut); }
    void        visit_bond_forces(const typename BondForce<dim>::VisitBond &visit) const override
    {
      bonds->visit_bond_forces(visit);
    }
    void                register_state(LastingState &state) override { bonds->register_state(state); }
    void                restore(const BondMemory &earlier) override { bonds->restore(earlier); }
    const BondList     &bond_list() const override { return bonds->bond_list(); }
    GlobalIndex         n_broken_now() const override { return bonds->n_broken_now(); }
    const NodeRecord   *positions() const override { return bonds->positions(); }
    std::vector<double> damage() const override { return bonds->damage(); }
    std::vector<double> cut_share() const override { return bonds->cut_share(); }
    std::vector<double> utilisation() const override { return bonds->utilisation(); }
    double              share_computed() const override { return bonds->share_computed(); }
    double              released_energy(const NodalVector &velocity, const double time_step) const override
    {
      return bonds->released_energy(velocity, time_step);
    }

    const std::vector<typename BondForce<dim>::LostBond> &lost_bonds() const override
    {
      return bonds->lost_bonds();
    }

    /// The force of the bonds.
    const BondForce<dim> &bond_force() const { return *bonds; }

  protected:
    WrappedBonds(std::unique_ptr<BondForce<dim>> force, const Families<dim> &families)
      : bonds(std::move(force))
    {
      this->partitioner = families.make_partitioner(dim);
    }

    std::unique_ptr<BondForce<dim>> bonds;
  };
} // namespace perideal

#endif
