// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/family_force.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

// What becomes of bonds of FamilyForce that are cut or break.

namespace perideal
{
  namespace
  {
    /// A stretch that no bond reaches, small enough for its product with a length to be finite.
    constexpr float never = 1e30f;
  } // namespace

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
  void FamilyForce<dim, n_sums, own_force_weights>::remove(const BondIndex slot)
  {
    weights.stiffness[slot] = 0;
    for (auto *list : {&weights.sum_weight, &weights.force_weight})
      if (list == &weights.sum_weight || own_force_weights)
        for (auto &ends : *list)
          ends.near[slot] = ends.far[slot] = 0;
    if (!critical_stretch.empty())
      critical_stretch[slot] = never;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::set_critical_stretch(
    const typename BondForce<dim>::CriticalStretch &stretch)
  {
    critical_stretch.assign(bonds.n_slots(), never);
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] != i && carries_force(slot))
          critical_stretch[slot] =
            static_cast<float>(std::min<double>(stretch(i, bonds.neighbour[slot]), never));
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  GlobalIndex FamilyForce<dim, n_sums, own_force_weights>::cut(const BondPredicate<dim> &is_cut)
  {
    // Bonds that the partition cuts stand on both ranks.
    GlobalIndex ends = 0;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] != i &&
            is_cut(families->position[i], families->position[bonds.neighbour[slot]]))
          {
            remove(slot);
            lose(slot, i, cut_volume);
            this->lost.push_back({slot, i, bonds.neighbour[slot]});
            ends += bonds.neighbour[slot] < families->n_owned() ? 2 : 1;
          }
    n_cut = this->lost.size();
    return dealii::Utilities::MPI::sum(ends, families->communicator) / 2;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::lose(const BondIndex      slot,
                                                         const LocalIndex     i,
                                                         std::vector<double> &volume)
  {
    const LocalIndex j = bonds.neighbour[slot];
    volume[i] += families->volume[j];
    if (j < families->n_owned())
      volume[j] += families->volume[i];
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::break_bonds(const LocalIndex i,
                                                                const BondIndex  first_slot,
                                                                const Lanes     &excess)
  {
    for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
      {
        if (!(excess[lane] > 0))
          continue;
        const BondIndex slot = first_slot + lane;
        BrokenBond      bond;
        bond.slot      = slot;
        bond.near      = i;
        bond.far       = bonds.neighbour[slot];
        bond.stiffness = weights.stiffness[slot];
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            bond.near_sum[a]   = weights.sum_weight[a].near[slot];
            bond.far_sum[a]    = weights.sum_weight[a].far[slot];
            bond.near_force[a] = weights.force_weights()[a].near[slot];
            bond.far_force[a]  = weights.force_weights()[a].far[slot];
          }
        broken_now.push_back(bond);
        this->lost.push_back({slot, i, bond.far});
        remove(slot);
        lose(slot, i, broken_volume);
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  GlobalIndex FamilyForce<dim, n_sums, own_force_weights>::n_broken_now() const
  {
    // Bonds that the partition cuts break on both ranks.
    GlobalIndex ends = 0;
    for (const BrokenBond &bond : broken_now)
      ends += bond.far < families->n_owned() ? 2 : 1;
    return dealii::Utilities::MPI::sum(ends, families->communicator) / 2;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  LocalIndex FamilyForce<dim, n_sums, own_force_weights>::near_end(const BondIndex slot) const
  {
    return std::upper_bound(bonds.row.begin(), bonds.row.end(), slot) - 1 - bonds.row.begin();
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  std::vector<BondEnds> FamilyForce<dim, n_sums, own_force_weights>::broken_bonds() const
  {
    std::vector<BondEnds> result;
    for (std::size_t k = n_cut; k < this->lost.size(); ++k)
      result.push_back({this->lost[k].near, this->lost[k].far});
    return result;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::restore_broken(const std::vector<BondEnds> &broken)
  {
    const std::size_t first = this->lost.size();
    for (const BondEnds &ends : broken)
      {
        const BondIndex slot = bonds.find(ends.near, ends.far);
        if (slot == BondList::no_slot || !carries_force(slot))
          continue;
        this->lost.push_back({slot, ends.near, ends.far});
        remove(slot);
        lose(slot, ends.near, broken_volume);
      }
    if (reweigh)
      reweigh_ends(first);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  std::vector<double>
  FamilyForce<dim, n_sums, own_force_weights>::share_of_family(const std::vector<double> &volume) const
  {
    std::vector<double> result(volume.size());
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i] = family_volume[i] > 0 ? volume[i] / family_volume[i] : 0.;
    return result;
  }

#define PERIDEAL_INSTANTIATE(dim, n_sums, own_force_weights)                                                   \
  template bool FamilyForce<dim, n_sums, own_force_weights>::carries_force(const BondIndex) const;             \
  template void FamilyForce<dim, n_sums, own_force_weights>::set_critical_stretch(                             \
    const BondForce<dim>::CriticalStretch &);                                                                  \
  template GlobalIndex FamilyForce<dim, n_sums, own_force_weights>::cut(const BondPredicate<dim> &);           \
  template void        FamilyForce<dim, n_sums, own_force_weights>::lose(                                      \
    const BondIndex, const LocalIndex, std::vector<double> &);                                          \
  template void FamilyForce<dim, n_sums, own_force_weights>::break_bonds(                                      \
    const LocalIndex, const BondIndex, const Lanes &);                                                         \
  template GlobalIndex           FamilyForce<dim, n_sums, own_force_weights>::n_broken_now() const;            \
  template LocalIndex            FamilyForce<dim, n_sums, own_force_weights>::near_end(const BondIndex) const; \
  template std::vector<BondEnds> FamilyForce<dim, n_sums, own_force_weights>::broken_bonds() const;            \
  template void FamilyForce<dim, n_sums, own_force_weights>::restore_broken(const std::vector<BondEnds> &);    \
  template std::vector<double> FamilyForce<dim, n_sums, own_force_weights>::share_of_family(                   \
    const std::vector<double> &) const;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE)
#undef PERIDEAL_INSTANTIATE
} // namespace perideal
