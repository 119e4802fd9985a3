// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/family_force.h>
#include <perideal/operators/weights/family_states.h>

#include <algorithm>

// The hot loops of FamilyForce: two passes over all bonds, one where forces need no sums.

namespace perideal
{
  namespace
  {
    /// Makes values of some owned nodes and of all ghosts zero.
    template <typename Values, typename Value>
    void
    clear(Values &values, const std::vector<LocalIndex> &nodes, const LocalIndex n_owned, const Value &zero)
    {
      for (const LocalIndex i : nodes)
        values[i] = zero;
      std::fill(values.begin() + n_owned, values.end(), zero);
    }
  } // namespace

  template <int dim, unsigned int n_sums, bool own_force_weights>
  template <typename FamilyForce<dim, n_sums, own_force_weights>::Failing failing>
  void FamilyForce<dim, n_sums, own_force_weights>::sum_over_families(const Levels levels)
  {
    const LocalIndex *neighbour = bonds.neighbour.data();
    const NodeRecord *y         = position.data();
    const double      unit_sum  = unit.sum;

    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      {
        if (skips(i, levels, [&](const LocalIndex block) { return regions.sums_awake(block); }))
          {
            i += RestRegions::block_size - 1;
            continue;
          }
        const Lanes               yi  = lanes(y[i]);
        std::array<Lanes, n_sums> own = {};
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += BondList::n_lanes)
          {
            const LocalIndex *j       = neighbour + k;
            const Lanes       bond[4] = {
                    lanes(y[j[0]]) - yi, lanes(y[j[1]]) - yi, lanes(y[j[2]]) - yi, lanes(y[j[3]]) - yi};
            Lanes square, rest;
            sum_of_each(square, bond[0] * bond[0], bond[1] * bond[1], bond[2] * bond[2], bond[3] * bond[3]);
            const Lanes length = square_root(square);
            load(rest, rest_length.data() + k);
            if constexpr (failing != Failing::not_at_all)
              {
                Lanes critical;
                load(critical, critical_stretch.data() + k);
                const Lanes margin = critical * rest - (length - rest);
                if (__builtin_expect(any_negative(margin), false))
                  break_bonds(i, k, -margin);
              }
            Lanes extension = (length - rest) * rest * unit_sum;
            if constexpr (failing == Failing::gradually)
              extension *= softening.shares_of(k);
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                Lanes near, far;
                load(near, weights.sum_weight[a].near.data() + k);
                load(far, weights.sum_weight[a].far.data() + k);
                own[a] += near * extension;
                far *= extension;
                double *sum = sums[a].data();
                for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
                  sum[j[lane]] += far[lane];
              }
          }
        for (unsigned int a = 0; a < n_sums; ++a)
          sums[a][i] += sum_of_all(own[a]);
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  template <typename FamilyForce<dim, n_sums, own_force_weights>::Failing failing>
  void FamilyForce<dim, n_sums, own_force_weights>::sum_forces(const Levels levels)
  {
    const LocalIndex *neighbour    = bonds.neighbour.data();
    const NodeRecord *y            = position.data();
    NodeRecord       *f            = forces.data();
    const auto       &pull_weights = weights.force_weights();
    const Lanes       tiny         = Lanes{} + 1e-300; // keeps padding, of length zero, from 0/0
    const double      unit_force = unit.force, unit_stiffness = unit.stiffness;

    for (LocalIndex i = 0; i < bonds.n_rows(); ++i)
      {
        if (skips(i, levels, [&](const LocalIndex block) { return regions.forces_awake(block); }))
          {
            i += RestRegions::block_size - 1;
            continue;
          }
        const Lanes yi  = lanes(y[i]);
        Lanes       own = {};
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += BondList::n_lanes)
          {
            const LocalIndex *j       = neighbour + k;
            const Lanes       bond[4] = {
                    lanes(y[j[0]]) - yi, lanes(y[j[1]]) - yi, lanes(y[j[2]]) - yi, lanes(y[j[3]]) - yi};
            Lanes square, rest, magnitude;
            sum_of_each(square, bond[0] * bond[0], bond[1] * bond[1], bond[2] * bond[2], bond[3] * bond[3]);
            const Lanes length = square_root(square + tiny);
            load(rest, rest_length.data() + k);
            if constexpr (n_sums == 0 && failing != Failing::not_at_all)
              {
                Lanes critical;
                load(critical, critical_stretch.data() + k);
                const Lanes margin = critical * rest - (length - rest);
                if (__builtin_expect(any_negative(margin), false))
                  break_bonds(i, k, -margin);
              }
            load(magnitude, weights.stiffness.data() + k);
            magnitude *= (length - rest) * rest * unit_stiffness;
            [[maybe_unused]] Lanes left;
            if constexpr (failing == Failing::gradually)
              {
                left = softening.shares_of(k);
                magnitude *= length > rest ? left : Lanes{} + 1.;
              }
            if constexpr (n_sums > 0)
              {
                Lanes by_states = {};
                for (unsigned int a = 0; a < n_sums; ++a)
                  {
                    Lanes near, far;
                    load(near, pull_weights[a].near.data() + k);
                    load(far, pull_weights[a].far.data() + k);
                    const double *s = state[a].data();
                    by_states += near * s[i] + far * Lanes{s[j[0]], s[j[1]], s[j[2]], s[j[3]]};
                  }
                if constexpr (failing == Failing::gradually)
                  by_states *= left;
                magnitude += by_states * unit_force;
              }
            magnitude *= rest / length;
            for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
              {
                const Lanes pull = magnitude[lane] * bond[lane];
                own += pull;
                lanes(f[j[lane]]) -= pull;
              }
          }
        lanes(f[i]) += own;
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::compute(NodalVector       &force,
                                                            const NodalVector &displacement)
  {
    broken_now.clear();
    this->move_nodes(displacement);
    // What softened carries its share, judged or not.
    if (softening.softens())
      do
        compute_forces<Failing::gradually>(force);
      while (this->find_out_limits());
    else if (!this->can_break())
      compute_forces<Failing::not_at_all>(force);
    else if (reweigh)
      compute_and_reweigh(force);
    else
      do
        compute_forces<Failing::at_once>(force);
      while (this->find_out_limits());
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyForce<dim, n_sums, own_force_weights>::compute_parts(std::vector<LevelledForce::Part> &parts,
                                                                  const NodalVector &displacement,
                                                                  const unsigned int highest)
  {
    const bool is_whole = highest + 1 == local_steps->n_levels();
    this->move_nodes(displacement, nullptr, is_whole ? nullptr : &local_steps->moving(highest));
    // Families of higher levels miss bonds in their sums; their members have not moved.
    if constexpr (n_sums > 0)
      {
        for (auto &values : sums)
          clear(values, local_steps->pulled(highest), families->n_owned(), 0.);
        sum_over_families<Failing::not_at_all>({0, highest});
        turn_sums_into_states<n_sums>(map, sums, state, ghosted_states, [&](const auto &visit) {
          for (const LocalIndex i : local_steps->families(highest))
            visit(i);
        });
      }
    for (unsigned int level = 0; level <= highest; ++level)
      {
        const std::vector<LocalIndex> &nodes = local_steps->pulled_alone(level);
        clear(forces, nodes, families->n_owned(), NodeRecord{});
        sum_forces<Failing::not_at_all>({level, level});
        for (const LocalIndex i : nodes)
          for (int d = 0; d < dim; ++d)
            parts[level].force.local_element(dim * i + d) = forces[i].value[d];
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  template <typename FamilyForce<dim, n_sums, own_force_weights>::Failing failing>
  void FamilyForce<dim, n_sums, own_force_weights>::compute_forces(NodalVector &force)
  {
    if constexpr (n_sums > 0)
      {
        for (auto &values : sums)
          std::fill(values.begin(), values.end(), 0.);
        sum_over_families<failing>({});
        turn_sums_into_states<n_sums>(map, sums, state, ghosted_states);
      }
    // The first pass has looked at the lengths.
    constexpr bool has_failed = n_sums > 0 && failing == Failing::at_once;
    std::fill(forces.begin(), forces.end(), NodeRecord{});
    sum_forces<has_failed ? Failing::not_at_all : failing>({});
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * i + d) = forces[i].value[d];
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template void FamilyForce<dim, n_sums, own_force_weights>::compute(NodalVector &, const NodalVector &);    \
  template void FamilyForce<dim, n_sums, own_force_weights>::compute_parts(                                  \
    std::vector<LevelledForce::Part> &, const NodalVector &, const unsigned int);                            \
  template void FamilyForce<dim, n_sums, own_force_weights>::compute_forces<                                 \
    FamilyForce<dim, n_sums, own_force_weights>::Failing::at_once>(NodalVector &);                           \
  template void FamilyForce<dim, n_sums, own_force_weights>::compute_forces<                                 \
    FamilyForce<dim, n_sums, own_force_weights>::Failing::not_at_all>(NodalVector &);
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
} // namespace perideal
