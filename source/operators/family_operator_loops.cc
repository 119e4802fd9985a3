// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/family_operator.h>
#include <perideal/operators/family_states.h>
#include <perideal/operators/nodal_records.h>

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
                load(scale, deformation.scale.data() + k);
                extension *= scale;
              }
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                Lanes near, far;
                load(near, weights->sum_weight[a].near.data() + k);
                load(far, weights->sum_weight[a].far.data() + k);
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
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::sum_forces() const
  {
    const LocalIndex *neighbour = weights->bonds.neighbour.data();
    const NodeRecord *x = positions.data(), *u = displacements.data();
    NodeRecord       *f            = forces.data();
    const auto       &pull_weights = weights->force_weights();
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
            Lanes       extension, magnitude;
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
                load(magnitude, deformation.stiffness.data() + k);
                extension *= scale;
              }
            else
              load(magnitude, weights->stiffness.data() + k);
            magnitude *= extension;
            for (unsigned int a = 0; a < n_sums; ++a)
              {
                Lanes near, far;
                load(near, pull_weights[a].near.data() + k);
                load(far, pull_weights[a].far.data() + k);
                const double *s         = state[a].data();
                const Lanes   far_state = dim + a < 4 ? Lanes{uj[0][(dim + a) % 4],
                                                            uj[1][(dim + a) % 4],
                                                            uj[2][(dim + a) % 4],
                                                            uj[3][(dim + a) % 4]} :
                                                        Lanes{s[j[0]], s[j[1]], s[j[2]], s[j[3]]};
                magnitude += near * s[i] + far * far_state;
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
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::vmult(NodalVector       &force,
                                                                       const NodalVector &displacement) const
  {
    import_displacement(displacement);
    if constexpr (n_sums > 0)
      {
        sum_over_families();
        turn_sums_into_states();
      }
    sum_forces();
    // Bonds pull node i along +xi when stretched; K u resists with the opposite sign.
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        force.local_element(dim * i + d) = -forces[i].value[d];
  }

#define PERIDEAL_INSTANTIATE(dim, n_sums, own_force_weights)                                                 \
  template class FamilyOperator<dim, n_sums, own_force_weights, false>;                                      \
  template class FamilyOperator<dim, n_sums, own_force_weights, true>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE)
#undef PERIDEAL_INSTANTIATE
} // namespace perideal
