// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/linear/family_operator.h>
#include <perideal/operators/weights/family_states.h>
#include <perideal/operators/weights/nodal_records.h>

#include <algorithm>

// The hot loops of FamilyOperator: two passes over all weights->bonds. What goes beyond the coordinates
// in the records of forces is never read.

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::import_displacement(
    const NodalVector &displacement) const
  {
    import_nodal_records<dim>(displacement, ghosted, displacements);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  template <bool shared, bool for_forces>
  PERIDEAL_INLINE void
  FamilyOperator<dim, n_sums, own_force_weights, deformed>::load_weights(FourBonds      &bonds,
                                                                         const BondIndex k) const
  {
    constexpr bool stiffness_in_record = n_sums == 1 && !own_force_weights;
    if constexpr (shared)
      {
        const LocalIndex *kind = weights->kind.data() + k;
        if constexpr (n_sums > 0)
          {
            const NodeRecord *record     = kinds.data();
            const Lanes       records[4] = {
                    lanes(record[kind[0]]), lanes(record[kind[1]]), lanes(record[kind[2]]), lanes(record[kind[3]])};
            Lanes value[4];
            transpose(records, value);
            constexpr int first = own_force_weights && for_forces ? 2 : 0;
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                bonds.near[a] = value[first + 2 * a];
                bonds.far[a]  = value[first + 2 * a + 1];
              }
            if constexpr (stiffness_in_record)
              bonds.stiffness = value[2];
          }
        if constexpr (for_forces && !deformed && !stiffness_in_record)
          {
            const double *s = weights->stiffness.data();
            bonds.stiffness = Lanes{s[kind[0]], s[kind[1]], s[kind[2]], s[kind[3]]};
          }
      }
    else
      {
        const auto &ends = for_forces ? weights->force_weights() : weights->sum_weight;
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            load(bonds.near[a], ends[a].near.data() + k);
            load(bonds.far[a], ends[a].far.data() + k);
          }
        if constexpr (for_forces && !deformed)
          load(bonds.stiffness, weights->stiffness.data() + k);
      }
    if constexpr (for_forces && deformed)
      load(bonds.stiffness, deformation.stiffness.data() + k);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  template <bool shared>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::sum_over_families() const
  {
    for (unsigned int a = 0; a < n_sums; ++a)
      std::fill(sums[a].begin(), sums[a].end(), 0.);
    const LocalIndex *neighbour = weights->bonds.neighbour.data();
    const NodeRecord *x = positions.data(), *u = displacements.data();

    for (LocalIndex i = 0; i < weights->bonds.n_rows(); ++i)
      {
        const Lanes               xi = lanes(x[i]), ui = lanes(u[i]);
        std::array<Lanes, n_sums> own = {};
        for (BondIndex k = weights->bonds.row[i]; k < weights->bonds.row[i + 1]; k += BondList::n_lanes)
          {
            const LocalIndex *j = neighbour + k;
            Lanes             extension;
            sum_of_each(extension,
                        (lanes(x[j[0]]) - xi) * (lanes(u[j[0]]) - ui),
                        (lanes(x[j[1]]) - xi) * (lanes(u[j[1]]) - ui),
                        (lanes(x[j[2]]) - xi) * (lanes(u[j[2]]) - ui),
                        (lanes(x[j[3]]) - xi) * (lanes(u[j[3]]) - ui));
            if constexpr (deformed)
              {
                Lanes scale;
                load(scale, deformation.of_sums().data() + k);
                extension *= scale;
              }
            FourBonds bonds;
            load_weights<shared, false>(bonds, k);
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                own[a] += bonds.near[a] * extension;
                const Lanes far = bonds.far[a] * extension;
                double     *sum = sums[a].data();
                for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
                  sum[j[lane]] += far[lane];
              }
          }
        for (unsigned int a = 0; a < n_sums; ++a)
          sums[a][i] += sum_of_all(own[a]);
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::turn_sums_into_states() const
  {
    perideal::turn_sums_into_states<n_sums>(weights->map, sums, state, ghosted_states);
    // In 2-D both states ride in the record of the displacement, in 3-D the first.
    for (LocalIndex i = 0; i < families->n_local(); ++i)
      for (unsigned int a = 0; a < n_sums && dim + a < 4; ++a)
        displacements[i].value[dim + a] = state[a][i];
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  template <bool shared>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::sum_forces() const
  {
    const LocalIndex *neighbour = weights->bonds.neighbour.data();
    const NodeRecord *x = positions.data(), *u = displacements.data();
    NodeRecord       *f = forces.data();
    std::fill(forces.begin(), forces.end(), NodeRecord{});

    for (LocalIndex i = 0; i < weights->bonds.n_rows(); ++i)
      {
        const Lanes xi = lanes(x[i]), ui = lanes(u[i]);
        Lanes       own = {};
        for (BondIndex k = weights->bonds.row[i]; k < weights->bonds.row[i + 1]; k += BondList::n_lanes)
          {
            const LocalIndex *j = neighbour + k;
            // x has zeros behind the coordinates, which keeps the states out of the sum.
            const Lanes bond[4] = {
              lanes(x[j[0]]) - xi, lanes(x[j[1]]) - xi, lanes(x[j[2]]) - xi, lanes(x[j[3]]) - xi};
            const Lanes uj[4] = {lanes(u[j[0]]), lanes(u[j[1]]), lanes(u[j[2]]), lanes(u[j[3]])};
            Lanes       extension;
            sum_of_each(extension,
                        bond[0] * (uj[0] - ui),
                        bond[1] * (uj[1] - ui),
                        bond[2] * (uj[2] - ui),
                        bond[3] * (uj[3] - ui));
            Lanes scale = {}, tension = {};
            if constexpr (deformed)
              {
                load(scale, deformation.scale.data() + k);
                load(tension, deformation.tension.data() + k);
                extension *= scale;
              }
            FourBonds bonds;
            load_weights<shared, true>(bonds, k);
            Lanes magnitude = bonds.stiffness * extension;
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                const double *s         = state[a].data();
                const Lanes   far_state = dim + a < 4 ? Lanes{uj[0][(dim + a) % 4],
                                                            uj[1][(dim + a) % 4],
                                                            uj[2][(dim + a) % 4],
                                                            uj[3][(dim + a) % 4]} :
                                                        Lanes{s[j[0]], s[j[1]], s[j[2]], s[j[3]]};
                magnitude += bonds.near[a] * s[i] + bonds.far[a] * far_state;
              }
            if constexpr (deformed)
              magnitude *= scale;
            for (unsigned int lane = 0; lane < BondList::n_lanes; ++lane)
              {
                Lanes pull = magnitude[lane] * bond[lane];
                if constexpr (deformed)
                  pull += tension[lane] * (uj[lane] - ui);
                own += pull;
                lanes(f[j[lane]]) -= pull;
              }
          }
        lanes(f[i]) += own;
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  template <bool shared>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::apply(const NodalVector &displacement) const
  {
    import_displacement(displacement);
    if constexpr (n_sums > 0)
      {
        sum_over_families<shared>();
        turn_sums_into_states();
      }
    sum_forces<shared>();
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::vmult(NodalVector       &force,
                                                                       const NodalVector &displacement) const
  {
    if (weights->kind.empty())
      apply<false>(displacement);
    else
      apply<true>(displacement);
    // Bonds pull node i along +xi when stretched; K u resists with the opposite sign.
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * i + d) = -forces[i].value[d];
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template class FamilyOperator<dim, n_sums, own_force_weights, false>;                                      \
  template class FamilyOperator<dim, n_sums, own_force_weights, true>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
} // namespace perideal
