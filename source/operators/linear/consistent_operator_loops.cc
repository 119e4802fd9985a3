// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/consistent_operator.h>

// The hot loops of ConsistentOperator: states and stresses of cells.

namespace perideal
{
  namespace
  {
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
  void ConsistentOperator<dim>::sum_over_bonds() const
  {
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        Pairs strain;
        to_pairs<dim>(moments->gradient(i), strain);
        dilatations[i] = 0;
        for (unsigned int d = 0; d < dim; ++d)
          dilatations[i] += strain[d];
        bonds->set_state(i, *moments->polynomial(i), strain);
      }
    bonds->sum_small();
  }

  template <int dim>
  void ConsistentOperator<dim>::turn_into_stress() const
  {
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        const auto  &C     = solids[solid_of_node[i]];
        const double share = bonds->share(i), volume = share * moments->cell_polynomials().volumes()[i];
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
          stress[p] = volume * stress[p] + bonds->stress(i, p);

        Pairs of_moment[dim];
        for (unsigned int k = 0; k < dim; ++k)
          {
            to_pairs<dim>(h + dim * k, strain);
            stress_of(strain, of_moment[k]);
          }
        if (expansion.counts)
          take_expansion(i, stress, of_moment);
        to_columns<dim>(stress, g);
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
                  stress[q] += share * inverse_moment[i][p] * of_moment[m][q];
              }
            to_columns<dim>(stress, h + dim * k);
          }
        moments->force(i) = bonds->force(i);
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::apply(NodalVector                                 &force,
                                      const NodalVector                           &displacement,
                                      const typename GradientMoments<dim>::AtFaces at_faces) const
  {
    moments->read(displacement, at_faces);
    expansion.counts = expansion.of_cells && at_faces == GradientMoments<dim>::AtFaces::values;
    expansion.energy = 0.;
    if (deformed)
      {
        deformed->sum_over_bonds();
        deformed->turn_into_stress();
      }
    else
      {
        sum_over_bonds();
        turn_into_stress();
      }
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

  template <int dim>
  void ConsistentOperator<dim>::add_increments(NodalVector &force) const
  {
    NodalVector still, from_faces;
    this->initialize(still);
    this->initialize(from_faces);
    apply(from_faces, still, GradientMoments<dim>::AtFaces::increments);
    force += from_faces;
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentOperator)
} // namespace perideal
