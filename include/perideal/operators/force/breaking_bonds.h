// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_breaking_bonds_h
#define perideal_operators_force_breaking_bonds_h

#include <perideal/base/lanes.h>
#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/force/rest_regions.h>

#include <deal.II/base/aligned_vector.h>

#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Holds what every BondForce has besides the forces: the present positions of the nodes, the bonds with
   * their lengths at rest, the stretches at which they break, and which of them broke.
   */
  template <int dim>
  class BreakingBonds : public BondForce<dim>
  {
  public:
    void                set_critical_stretch(const typename BondForce<dim>::CriticalStretch &stretch,
                                             const SofteningLaw                             &law = SofteningLaw(),
                                             const typename BondForce<dim>::CriticalStretch &first = {}) override;
    void                judge_bonds(const bool judge) override;
    GlobalIndex         cut(const BondPredicate<dim> &is_cut) override;
    GlobalIndex         n_broken_now() const override;
    void                register_state(LastingState &state) override;
    const BondList     &bond_list() const override { return bonds; }
    const NodeRecord   *positions() const override { return position.data(); }
    std::vector<double> damage() const override;
    std::vector<double> cut_share() const override { return share_of_family(volumes.cut); }
    double              share_computed() const override { return regions.share_awake(); }

  protected:
    /// @param has_sums whether forces need sums over families first
    BreakingBonds(const std::shared_ptr<const Families<dim>> &families,
                  const BondList                             &bonds,
                  const bool                                  has_sums);

    /// False of padding, and of bonds that were cut or broke.
    virtual bool carries_force(const BondIndex slot) const = 0;
    /// Makes all weights of a bond zero.
    virtual void clear_weights(const BondIndex slot) = 0;

    /// Breaks bonds again that broke in an earlier run. Those that are no bonds here are left out.
    virtual void restore_broken(const std::vector<BondEnds> &broken);

    /// Whether compute() has to look for bonds that break or soften.
    bool can_break() const { return (judges_bonds || softening.softens()) && !critical_stretch.empty(); }

    /// Takes the displacement; from here on bonds break now. Collective.
    /// @param records of the local nodes, which get the displacement itself where a force needs it; may be
    /// null
    void move_nodes(const NodalVector &displacement, dealii::AlignedVector<NodeRecord> *records = nullptr);

    /// Softens or breaks a bond of this stretch, which is beyond its limit; the caller has looked at its
    /// weights.
    SofteningBonds::Change overstretch(const BondIndex slot, const LocalIndex near, const double stretch);

    /// Breaks a bond, the weights of which the caller has looked at.
    void break_bond(const BondIndex slot, const LocalIndex near);

    /// The row that holds the slot.
    LocalIndex near_end(const BondIndex slot) const;

    std::size_t breaking_memory() const;

    using BondForce<dim>::softening;

    std::shared_ptr<const Families<dim>> families;
    BondList                             bonds;
    /// Lengths at rest by slot [m].
    std::vector<double> rest_length;
    /// Stretches beyond which bonds break or go on to soften, by slot; empty where nothing breaks.
    std::vector<float>                critical_stretch;
    RestRegions                       regions;
    dealii::AlignedVector<NodeRecord> position, forces;

  private:
    /// The bonds of this rank that broke so far, in this order; those that the partition cuts are on both
    /// ranks.
    std::vector<BondEnds> broken_bonds() const;
    /// Takes out a bond: its weights and its limit.
    void remove(const BondIndex slot);
    /// Adds the volumes behind a bond to those of its owned ends.
    void                lose(const BondIndex slot, const LocalIndex i, std::vector<double> &volume) const;
    void                measure_rest_lengths();
    std::vector<double> share_of_family(const std::vector<double> &volume) const;

    bool judges_bonds = true;
    /// Of the families of owned nodes [m^3]: whole, behind bonds that broke, and behind bonds that were cut.
    struct Volumes
    {
      std::vector<double> family, broken, cut;
    };
    Volumes volumes;
    /// Of the lost bonds, those that were cut at the beginning, and those lost before the last compute().
    std::size_t n_cut = 0, n_lost_before = 0;
    NodalVector ghosted;
  };
} // namespace perideal

#endif
