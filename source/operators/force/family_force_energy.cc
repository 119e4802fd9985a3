// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/family_force.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

// What FamilyForce tells of the last compute(): energies, and the forces of single bonds.

namespace perideal
{
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
        const double along = position[j].value[d] - position[i].value[d];
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
      result = family.sum[0] * family.force[0] + energy[i] * family.sum[0] * family.sum[0];
    else
      {
        const States s = map.states(i, family.sum);
        for (unsigned int a = 0; a < n_sums; ++a)
          result += 0.5 * family.sum[a] * s[a];
      }
    return result;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  std::vector<BondCursor::End> FamilyForce<dim, n_sums, own_force_weights>::slots_of(const LocalIndex i) const
  {
    std::vector<BondCursor::End> result;
    // As far as a bond may reach, generously.
    const auto reach = [&](const LocalIndex from, const LocalIndex to) {
      return (1. + 1e-8) * families->horizon[from] +
             (families->cell_radius.empty() ? 0. : families->cell_radius[to]);
    };
    regions.visit_rows_with(i, [&](const LocalIndex j) {
      // Most of the rows hold other nodes: the distance tells so faster than a search.
      if (families->position[i].distance(families->position[j]) > std::max(reach(i, j), reach(j, i)))
        return;
      const BondIndex slot = bonds.find(j, i);
      if (slot != BondList::no_slot)
        result.push_back({slot, false});
    });
    for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1] && bonds.neighbour[slot] != i; ++slot)
      result.push_back({slot, true});
    return result;
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::visit_bond_forces(
    const typename BondForce<dim>::VisitBond &visit) const
  {
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      for (BondIndex slot = bonds.row[i]; slot < bonds.row[i + 1]; ++slot)
        if (const LocalIndex j = bonds.neighbour[slot]; j != i)
          {
            dealii::Tensor<1, dim> y;
            for (int d = 0; d < dim; ++d)
              y[d] = position[j].value[d] - position[i].value[d];
            const double length = y.norm(), rest = rest_length[slot];
            const double longer = length - rest, left = softening.share(slot);
            double       magnitude = softening.stiffness_left(slot, longer) * stiffness(slot) * longer * rest;
            for (unsigned int a = 0; a < n_sums; ++a)
              magnitude += left * (force_weight(a, {slot, true}) * state[a][i] +
                                   force_weight(a, {slot, false}) * state[a][j]);
            visit(i, j, length > 0 ? magnitude * rest / length * y : dealii::Tensor<1, dim>());
          }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  double FamilyForce<dim, n_sums, own_force_weights>::strain_energy() const
  {
    // Where dissipated energy is controlled, this is read often: four bonds at once, as forces are summed.
    const LocalIndex    n_owned   = families->n_owned();
    const bool          softens   = softening.softens();
    const LocalIndex   *neighbour = bonds.neighbour.data();
    const NodeRecord   *y         = position.data();
    const Lanes         one       = Lanes{} + 1.;
    double              result    = 0;
    std::vector<double> force(own_force_weights ? families->n_local() : 0, 0.);
    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      {
        const Lanes            yi        = lanes(y[i]);
        Lanes                  of_bonds  = {};
        [[maybe_unused]] Lanes own_force = {};
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += BondList::n_lanes)
          {
            Lanes constant;
            load(constant, weights.stiffness.data() + k);
            // In a zone, most bonds of the rows around it have no weight.
            if (!own_force_weights && constant[0] == 0. && constant[1] == 0. && constant[2] == 0. &&
                constant[3] == 0.)
              continue;
            const LocalIndex *j       = neighbour + k;
            const Lanes       bond[4] = {
                    lanes(y[j[0]]) - yi, lanes(y[j[1]]) - yi, lanes(y[j[2]]) - yi, lanes(y[j[3]]) - yi};
            Lanes square, rest;
            sum_of_each(square, bond[0] * bond[0], bond[1] * bond[1], bond[2] * bond[2], bond[3] * bond[3]);
            load(rest, rest_length.data() + k);
            const Lanes eps            = (square_root(square) - rest) * rest;
            const Lanes left           = softens ? softening.shares_of(k) : one;
            const Lanes energy_of_each = (eps > 0. ? left : one) * constant * eps * eps;
            // Half of a bond that the partition cuts.
            of_bonds += energy_of_each * Lanes{j[0] < n_owned ? 1. : 0.5,
                                               j[1] < n_owned ? 1. : 0.5,
                                               j[2] < n_owned ? 1. : 0.5,
                                               j[3] < n_owned ? 1. : 0.5};
            if constexpr (own_force_weights)
              {
                Lanes near, far;
                load(near, weights.force_weights()[0].near.data() + k);
                load(far, weights.force_weights()[0].far.data() + k);
                own_force += near * left * eps;
                far *= left * eps;
                for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
                  force[j[lane]] += far[lane];
              }
          }
        result += 0.5 * unit.stiffness * sum_of_all(of_bonds);
        if constexpr (own_force_weights)
          force[i] += sum_of_all(own_force);
      }
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        FamilySums family;
        for (unsigned int a = 0; a < n_sums; ++a)
          family.sum[a] = sums[a][i];
        if constexpr (own_force_weights)
          family.force[0] = unit.force * force[i];
        result += family_energy(i, family);
      }
    return dealii::Utilities::MPI::sum(result, families->communicator);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  double FamilyForce<dim, n_sums, own_force_weights>::released_energy(const NodalVector &velocity,
                                                                      const double       time_step) const
  {
    // The weights of bonds that hold have changed too: by whole evaluations.
    if (reweigh)
      return energy_before - strain_energy() - 0.5 * time_step * (velocity * force_change);
    const LocalIndex n_owned = families->n_owned();
    NodalVector      ghosted_velocity(this->partitioner);
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
            const LocalIndex near = bonds.near_end(end.slot);
            const Motion     m    = motion(end.slot, near, bonds.neighbour[end.slot], velocity_of);
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                const double weight = softening.share(end.slot) * force_weight(a, end);
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
        const States state_after = map.states(i, after.sum), state_before = map.states(i, before.sum);
        for (unsigned int a = 0; a < n_sums; ++a)
          power -= state_after[a] * after.force_rate[a] - state_before[a] * before.force_rate[a];
      }
    return dealii::Utilities::MPI::sum(-energy - 0.5 * time_step * power, families->communicator);
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template void FamilyForce<dim, n_sums, own_force_weights>::visit_bond_forces(                              \
    const typename BondForce<dim>::VisitBond &) const;                                                       \
  template double FamilyForce<dim, n_sums, own_force_weights>::strain_energy() const;                        \
  template double FamilyForce<dim, n_sums, own_force_weights>::released_energy(const NodalVector &,          \
                                                                               const double) const;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
} // namespace perideal
