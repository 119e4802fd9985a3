// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/family_force.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

// Set-up of FamilyForce, and what becomes of broken bonds.

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights>
  FamilyForce<dim, n_sums, own_force_weights>::FamilyForce(const std::shared_ptr<Weights> &weights)
    : weights(weights)
    , families(weights->families)
    , rest_length(weights->bonds.n_slots(), 0.)
    , regions(*families, weights->bonds, n_sums > 0)
  {
    this->partitioner = families->make_partitioner(dim);
    ghosted.reinit(this->partitioner);
    ghosted_velocity.reinit(this->partitioner);
    if (n_sums > 0)
      ghosted_states.reinit(families->make_partitioner(n_sums));
    positions.resize(families->n_local(), NodeRecord{});
    forces.resize(families->n_local(), NodeRecord{});
    for (unsigned int a = 0; a < n_sums; ++a)
      {
        sums[a].resize(families->n_local());
        state[a].resize(families->n_local());
      }

    family_volume.assign(families->n_owned(), 0.);
    broken_volume = cut_volume = family_volume;
    const BondList &bonds      = weights->bonds;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] != i)
          lose(slot, i, family_volume);
    measure_rest_lengths();
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::set_critical_stretch(
    const typename BondForce<dim>::CriticalStretch &stretch)
  {
    const BondList &bonds = weights->bonds;
    largest_length.assign(bonds.n_slots(), std::numeric_limits<double>::infinity());
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] != i && weights->stiffness[slot] != 0)
          largest_length[slot] = rest_length[slot] * (1. + stretch(i, bonds.neighbour[slot]));
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::cut(
    const std::function<bool(const dealii::Point<dim> &, const dealii::Point<dim> &)> &cut)
  {
    const BondList &bonds = weights->bonds;
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (bonds.neighbour[slot] != i && weights->stiffness[slot] != 0 &&
            cut(families->position[i], families->position[bonds.neighbour[slot]]))
          {
            weights->remove(slot);
            lose(slot, i, cut_volume);
            if (!largest_length.empty())
              largest_length[slot] = std::numeric_limits<double>::infinity();
          }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::lose(const BondIndex      slot,
                                                         const LocalIndex     i,
                                                         std::vector<double> &volume)
  {
    const LocalIndex j = weights->bonds.neighbour[slot];
    volume[i] += families->volume[j];
    if (j < families->n_owned())
      volume[j] += families->volume[i];
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::break_bonds(const LocalIndex i,
                                                                const BondIndex  first_slot,
                                                                const Lanes     &length)
  {
    for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
      {
        const BondIndex slot = first_slot + lane;
        if (!(length[lane] > largest_length[slot]))
          continue;
        BrokenBond bond;
        bond.slot      = slot;
        bond.near      = i;
        bond.far       = weights->bonds.neighbour[slot];
        bond.stiffness = weights->stiffness[slot];
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            bond.near_sum[a]   = weights->sum_weight[a].near[slot];
            bond.far_sum[a]    = weights->sum_weight[a].far[slot];
            bond.near_force[a] = weights->force_weights()[a].near[slot];
            bond.far_force[a]  = weights->force_weights()[a].far[slot];
          }
        broken_now.push_back(bond);
        weights->remove(slot);
        largest_length[slot] = std::numeric_limits<double>::infinity();
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
  template <typename Velocity>
  typename FamilyForce<dim, n_sums, own_force_weights>::Motion
  FamilyForce<dim, n_sums, own_force_weights>::motion(const BondIndex  slot,
                                                      const LocalIndex i,
                                                      const LocalIndex j,
                                                      const Velocity  &velocity) const
  {
    double square = 0, growth = 0;
    for (int d = 0; d < dim; ++d)
      {
        const double along = positions[j].value[d] - positions[i].value[d];
        square += along * along;
        growth += along * (velocity(j, d) - velocity(i, d));
      }
    const double length = std::sqrt(square), rest = rest_length[slot];
    return {(length - rest) * rest, length > 0 ? growth / length * rest : 0.};
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  double FamilyForce<dim, n_sums, own_force_weights>::family_energy(const LocalIndex  i,
                                                                    const FamilySums &family) const
  {
    double result = 0;
    if constexpr (own_force_weights)
      result = family.sum[0] * family.force[0] + weights->energy[i] * family.sum[0] * family.sum[0];
    else
      {
        const States s = weights->states(i, family.sum);
        for (unsigned int a = 0; a < n_sums; ++a)
          result += 0.5 * family.sum[a] * s[a];
      }
    return result;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  std::vector<BondCursor::End> FamilyForce<dim, n_sums, own_force_weights>::slots_of(const LocalIndex i) const
  {
    const BondList              &bonds = weights->bonds;
    std::vector<BondCursor::End> result;
    for (const LocalIndex *j = families->begin(i); j != families->end(i) && *j < i; ++j)
      {
        const auto begin = bonds.neighbour.begin() + bonds.row[*j];
        auto       end   = bonds.neighbour.begin() + bonds.row[*j + 1];
        while (end != begin && *(end - 1) == *j) // padding
          --end;
        result.push_back(
          {static_cast<BondIndex>(std::lower_bound(begin, end, i) - bonds.neighbour.begin()), false});
      }
    for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1] && bonds.neighbour[slot] != i; ++slot)
      result.push_back({slot, true});
    return result;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  double FamilyForce<dim, n_sums, own_force_weights>::strain_energy() const
  {
    const BondList  &bonds   = weights->bonds;
    const LocalIndex n_owned = families->n_owned();
    const auto       at_rest = [](const LocalIndex, const int) { return 0.; };

    double              result = 0;
    std::vector<States> force(own_force_weights ? n_owned : 0, States{});
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        {
          const LocalIndex j     = bonds.neighbour[slot];
          const double     eps   = motion(slot, i, j, at_rest).eps;
          const double     share = j < n_owned ? 1. : 0.5;
          result += share * 0.5 * weights->stiffness[slot] * eps * eps;
          if constexpr (own_force_weights)
            {
              force[i][0] += weights->force_weight[0].near[slot] * eps;
              if (j < n_owned)
                force[j][0] += weights->force_weight[0].far[slot] * eps;
            }
        }
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        FamilySums family;
        for (unsigned int a = 0; a < n_sums; ++a)
          family.sum[a] = sums[a][i];
        if constexpr (own_force_weights)
          family.force = force[i];
        result += family_energy(i, family);
      }
    return dealii::Utilities::MPI::sum(result, families->communicator);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  double FamilyForce<dim, n_sums, own_force_weights>::released_energy(const NodalVector &velocity,
                                                                      const double       time_step) const
  {
    const LocalIndex n_owned = families->n_owned();
    std::copy(velocity.begin(), velocity.end(), ghosted_velocity.begin());
    ghosted_velocity.update_ghost_values();
    const auto velocity_of = [&](const LocalIndex i, const int d) {
      return ghosted_velocity.local_element(dim * i + d);
    };

    // The strain energy is that of the bonds, eps^2 stiffness/2, and of the families; the power of the
    // bond forces, sum v.f, is -sum stiffness eps eps' - sum A.(force sums)'.
    double                                          energy = 0, power = 0;
    std::vector<std::pair<LocalIndex, std::size_t>> broken_at;
    for (std::size_t b = 0; b < broken_now.size(); ++b)
      {
        const BrokenBond &bond  = broken_now[b];
        const Motion      m     = motion(bond.slot, bond.near, bond.far, velocity_of);
        const double      share = bond.far < n_owned ? 1. : 0.5;
        energy -= share * 0.5 * bond.stiffness * m.eps * m.eps;
        power += share * bond.stiffness * m.eps * m.rate;
        broken_at.emplace_back(bond.near, b);
        if (bond.far < n_owned)
          broken_at.emplace_back(bond.far, b);
      }
    std::sort(broken_at.begin(), broken_at.end());

    for (auto at = broken_at.begin(); n_sums > 0 && at != broken_at.end();)
      {
        const LocalIndex i = at->first;
        FamilySums       after;
        for (unsigned int a = 0; a < n_sums; ++a)
          after.sum[a] = sums[a][i];
        for (const BondCursor::End &end : slots_of(i))
          {
            const auto row =
              std::upper_bound(weights->bonds.row.begin(), weights->bonds.row.end(), end.slot) - 1;
            const LocalIndex near = row - weights->bonds.row.begin();
            const Motion     m    = motion(end.slot, near, weights->bonds.neighbour[end.slot], velocity_of);
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                const auto  &ends   = weights->force_weights()[a];
                const double weight = (end.is_near ? ends.near : ends.far)[end.slot];
                after.force[a] += weight * m.eps;
                after.force_rate[a] += weight * m.rate;
              }
          }
        FamilySums before = after;
        for (; at != broken_at.end() && at->first == i; ++at)
          {
            const BrokenBond &bond    = broken_now[at->second];
            const Motion      m       = motion(bond.slot, bond.near, bond.far, velocity_of);
            const bool        is_near = bond.near == i;
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                before.sum[a] += (is_near ? bond.near_sum : bond.far_sum)[a] * m.eps;
                before.force[a] += (is_near ? bond.near_force : bond.far_force)[a] * m.eps;
                before.force_rate[a] += (is_near ? bond.near_force : bond.far_force)[a] * m.rate;
              }
          }
        energy += family_energy(i, after) - family_energy(i, before);
        const States state_after  = weights->states(i, after.sum),
                     state_before = weights->states(i, before.sum);
        for (unsigned int a = 0; a < n_sums; ++a)
          power -= state_after[a] * after.force_rate[a] - state_before[a] * before.force_rate[a];
      }
    ghosted_velocity.zero_out_ghost_values();
    return dealii::Utilities::MPI::sum(-energy - 0.5 * time_step * power, families->communicator);
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

  template <int dim, unsigned int n_sums, bool own_force_weights>
  std::size_t FamilyForce<dim, n_sums, own_force_weights>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return weights->memory_consumption() + memory_consumption(rest_length) +
           memory_consumption(largest_length) + 3 * memory_consumption(family_volume) +
           2 * positions.size() * sizeof(NodeRecord) + 2 * n_sums * families->n_local() * sizeof(double);
  }

  template <int dim>
  std::unique_ptr<BondForce<dim>> create_bond_force(const std::shared_ptr<BondWeights<dim>> &weights)
  {
    return visit_family_shape(weights->shape,
                              [&](const auto n_sums, const auto own) -> std::unique_ptr<BondForce<dim>> {
                                return std::make_unique<FamilyForce<dim, n_sums, own>>(
                                  std::static_pointer_cast<FamilyWeights<dim, n_sums, own>>(weights));
                              });
  }

#define PERIDEAL_INSTANTIATE(dim, n_sums, own_force_weights)                                                 \
  template class FamilyForce<dim, n_sums, own_force_weights>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE)
#undef PERIDEAL_INSTANTIATE
  template std::unique_ptr<BondForce<2>> create_bond_force(const std::shared_ptr<BondWeights<2>> &);
  template std::unique_ptr<BondForce<3>> create_bond_force(const std::shared_ptr<BondWeights<3>> &);
} // namespace perideal
