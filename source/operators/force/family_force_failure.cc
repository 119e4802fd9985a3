// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/family_force.h>

#include <algorithm>

// What becomes of bonds of FamilyForce that are cut or break.

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights>
  bool FamilyForce<dim, n_sums, own_force_weights>::carries_force(const BondIndex slot) const
  {
    const auto at_ends = [&](const auto &sums) {
      return std::any_of(sums.begin(), sums.end(), [&](const auto &ends) {
        return ends.near[slot] != 0 || ends.far[slot] != 0;
      });
    };
    return weights.stiffness[slot] != 0 || at_ends(weights.sum_weight) ||
           (own_force_weights && at_ends(weights.force_weight));
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::clear_weights(const BondIndex slot)
  {
    weights.stiffness[slot] = 0;
    for (auto *list : {&weights.sum_weight, &weights.force_weight})
      if (list == &weights.sum_weight || own_force_weights)
        for (auto &ends : *list)
          ends.near[slot] = ends.far[slot] = 0;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::break_bonds(const LocalIndex i,
                                                                const BondIndex  first_slot,
                                                                const Lanes     &excess)
  {
    for (unsigned int lane = 0; lane < BondList::n_lanes && this->can_break(); ++lane)
      {
        const BondIndex slot = first_slot + lane;
        if (!(excess[lane] > 0) || this->unknown.holds(slot))
          continue;
        BrokenBond bond;
        bond.slot      = slot;
        bond.near      = i;
        bond.far       = bonds.neighbour[slot];
        bond.stiffness = stiffness(slot);
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            bond.near_sum[a]   = sum_weight(a, {slot, true});
            bond.far_sum[a]    = sum_weight(a, {slot, false});
            bond.near_force[a] = force_weight(a, {slot, true});
            bond.far_force[a]  = force_weight(a, {slot, false});
          }
        const auto change =
          this->overstretch(slot, i, critical_stretch[slot] + excess[lane] / rest_length[slot]);
        bond.scale(change.before - change.after);
        broken_now.push_back(bond);
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::restore_broken(const std::vector<BondEnds> &broken)
  {
    const std::size_t first = this->lost.size();
    BreakingBonds<dim>::restore_broken(broken);
    if (reweigh)
      reweigh_ends(first);
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template bool FamilyForce<dim, n_sums, own_force_weights>::carries_force(const BondIndex) const;           \
  template void FamilyForce<dim, n_sums, own_force_weights>::clear_weights(const BondIndex);                 \
  template void FamilyForce<dim, n_sums, own_force_weights>::break_bonds(                                    \
    const LocalIndex, const BondIndex, const Lanes &);                                                       \
  template void FamilyForce<dim, n_sums, own_force_weights>::restore_broken(const std::vector<BondEnds> &);
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
} // namespace perideal
