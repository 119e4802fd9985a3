// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/record_exchange.h>
#include <perideal/operators/linear/consistent_operator.h>

#include <algorithm>

// The hot loops of ConsistentOperator: states of cells, bonds, stresses of cells.

namespace perideal
{
  namespace
  {
    /// xi (x) xi of a bond, as in a PairRecord.
    PERIDEAL_INLINE void multiply_out(const Lanes &bond, std::array<Lanes, 1> &products)
    {
      products[0] =
        __builtin_shufflevector(bond, bond, 0, 1, 0, 3) * __builtin_shufflevector(bond, bond, 0, 1, 1, 3);
    }

    PERIDEAL_INLINE void multiply_out(const Lanes &bond, std::array<Lanes, 2> &products)
    {
      products[0] = bond * bond;
      products[1] = bond * __builtin_shufflevector(bond, bond, 1, 2, 0, 3);
    }

    /// Pairs (xx, yy, .., 2xy, ..) of the tensor with the columns t_l, lanes by row.
    template <int dim>
    PERIDEAL_INLINE void to_pairs(const NodeRecord *t, typename SymmetricPairs<dim>::Pairs &pairs)
    {
      for (unsigned int p = 0; p < SymmetricPairs<dim>::n_pairs; ++p)
        {
          const auto [a, b] = SymmetricPairs<dim>::axes(p);
          pairs[p]          = a == b ? t[a].value[a] : t[b].value[a] + t[a].value[b];
        }
    }

    /// The symmetric tensor of such pairs without the twos, by columns.
    template <int dim>
    PERIDEAL_INLINE void to_columns(const typename SymmetricPairs<dim>::Pairs &pairs, NodeRecord *t)
    {
      for (unsigned int p = 0; p < SymmetricPairs<dim>::n_pairs; ++p)
        {
          const auto [a, b] = SymmetricPairs<dim>::axes(p);
          t[a].value[b] = t[b].value[a] = pairs[p];
        }
    }
  } // namespace

  template <int dim>
  void ConsistentOperator<dim>::import_states() const
  {
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        NodeRecord *state = work.states.data() + n_records * i;
        state[0]          = moments->value(i);
        Pairs pairs;
        to_pairs<dim>(moments->gradient(i), pairs);
        work.dilatation[i] = 0;
        for (unsigned int d = 0; d < dim; ++d)
          work.dilatation[i] += pairs[d];
        for (unsigned int p = 0; p < n_pairs; ++p)
          state[1 + (dim == 2 ? 0 : p / 3)].value[dim == 2 ? p : p % 3] = pairs[p];
      }
    update_ghosts(*of_states, work.states, work.temporary);
  }

  template <int dim>
  void ConsistentOperator<dim>::sum_over_bonds() const
  {
    using Parts                    = std::array<Lanes, n_parts>;
    constexpr unsigned int n_lanes = BondList::n_lanes;
    const NodeRecord      *x = positions.data(), *state = work.states.data();
    NodeRecord            *f = work.forces.data(), *stress = work.stresses.data();
    std::fill(work.forces.begin(), work.forces.end(), NodeRecord{});
    std::fill(work.stresses.begin(), work.stresses.end(), NodeRecord{});

    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        const NodeRecord *near = state + n_records * i;
        const Lanes       xi = lanes(x[i]), ui    = lanes(near[0]);
        Parts             near_strain, own_stress = {};
        for (unsigned int p = 0; p < n_parts; ++p)
          near_strain[p] = lanes(near[1 + p]);
        Lanes own = {};
        for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; k += n_lanes)
          {
            const LocalIndex *j = bonds.neighbour.data() + k;
            Lanes             bond[n_lanes], part[n_lanes];
            Parts             square[n_lanes];
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                const NodeRecord *far = state + n_records * j[l];
                bond[l]               = lanes(x[j[l]]) - xi;
                multiply_out(bond[l], square[l]);
                part[l] = bond[l] * (lanes(far[0]) - ui);
                for (unsigned int p = 0; p < n_parts; ++p)
                  part[l] -= 0.5 * (near_strain[p] + lanes(far[1 + p])) * square[l][p];
              }
            Lanes pull, factor;
            sum_of_each(pull, part[0], part[1], part[2], part[3]);
            load(factor, stiffness.data() + k);
            pull *= factor;
            for (unsigned int l = 0; l < n_lanes; ++l)
              {
                const Lanes force = pull[l] * bond[l];
                own -= force;
                lanes(f[j[l]]) += force;
                NodeRecord *of_far = stress + n_parts * j[l];
                for (unsigned int p = 0; p < n_parts; ++p)
                  {
                    const Lanes change = (0.5 * pull[l]) * square[l][p];
                    own_stress[p] -= change;
                    lanes(of_far[p]) -= change;
                  }
              }
          }
        lanes(f[i]) += own;
        for (unsigned int p = 0; p < n_parts; ++p)
          lanes(stress[n_parts * i + p]) += own_stress[p];
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::turn_into_stress() const
  {
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        const auto  &C      = solids[solid_of_node[i]];
        const double volume = moments->cell_polynomials().volumes()[i];
        NodeRecord  *g = moments->gradient(i), *h = moments->moment(i);
        const auto   stress_of = [&](const Pairs &strain, Pairs &stress) {
          for (unsigned int p = 0; p < n_pairs; ++p)
            {
              stress[p] = 0.;
              for (unsigned int q = 0; q < n_pairs; ++q)
                stress[p] += C[p][q] * strain[q];
            }
        };
        Pairs strain, stress;
        to_pairs<dim>(g, strain);
        stress_of(strain, stress);
        for (unsigned int p = 0; p < n_pairs; ++p)
          stress[p] = volume * stress[p] +
                      (dim == 2 ? work.stresses[i].value[p] : work.stresses[2 * i + p / 3].value[p % 3]);
        to_columns<dim>(stress, g);

        Pairs of_moment[dim];
        for (unsigned int k = 0; k < dim; ++k)
          {
            to_pairs<dim>(h + dim * k, strain);
            stress_of(strain, of_moment[k]);
          }
        for (unsigned int k = 0; k < dim; ++k)
          {
            stress = {};
            for (unsigned int p = 0; p < n_pairs; ++p)
              {
                const auto [a, b] = Symmetric::axes(p);
                if (a != k && b != k)
                  continue;
                const unsigned int m = a == k ? b : a;
                for (unsigned int q = 0; q < n_pairs; ++q)
                  stress[q] += inverse_moment[i][p] * of_moment[m][q];
              }
            to_columns<dim>(stress, h + dim * k);
          }
        moments->force(i) = work.forces[i];
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::apply(NodalVector                                 &force,
                                      const NodalVector                           &displacement,
                                      const typename GradientMoments<dim>::AtFaces at_faces) const
  {
    moments->read(displacement, at_faces);
    import_states();
    sum_over_bonds();
    turn_into_stress();
    moments->transpose(force);
  }

  template <int dim>
  void ConsistentOperator<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    apply(force, displacement, GradientMoments<dim>::AtFaces::nothing);
  }

  template <int dim>
  void ConsistentOperator<dim>::internal_force(NodalVector &force, const NodalVector &displacement) const
  {
    apply(force, displacement, GradientMoments<dim>::AtFaces::values);
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentOperator)
} // namespace perideal
