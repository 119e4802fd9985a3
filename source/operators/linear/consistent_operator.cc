// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/consistent_operator.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

// Set-up of ConsistentOperator and what it reports besides forces.

namespace perideal
{
  template <int dim>
  ConsistentOperator<dim>::ConsistentOperator(const std::shared_ptr<const Families<dim>>        &families,
                                              const std::shared_ptr<const GradientMoments<dim>> &moments,
                                              const std::shared_ptr<ConsistentBonds<dim>>       &bonds,
                                              const SolidOf<dim>                                &solid_of)
    : families(families)
    , moments(moments)
    , bonds(bonds)
    , dilatations(families->n_owned())
  {
    const LocalIndex n_owned = families->n_owned();
    this->partitioner        = families->make_partitioner(dim);
    set_solids(solid_of);
    set_moments();

    const std::vector<bool> &deficient = moments->cell_polynomials().deficient();
    this->reports.resize(n_owned);
    for (LocalIndex i = 0; i < n_owned; ++i)
      {
        this->reports[i].singular = deficient[i];
        this->counts.singular += deficient[i];
      }
    this->counts.singular = dealii::Utilities::MPI::sum(this->counts.singular, families->communicator);
  }

  template <int dim>
  void ConsistentOperator<dim>::linearise(const BondForce<dim> &force, const Slope)
  {
    const auto *from = dynamic_cast<const ConsistentForce<dim> *>(&force);
    AssertThrow(from != nullptr, dealii::ExcInternalError());
    if (!from->is_linear())
      deformed.emplace(*families, moments, bonds, *from);
  }

  template <int dim>
  void ConsistentOperator<dim>::set_solids(const SolidOf<dim> &solid_of)
  {
    std::map<dealii::types::material_id, LocalIndex> number;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        const auto inserted = number.insert({families->material[i], solids.size()});
        if (inserted.second)
          {
            const auto                 of = solid_of(families->material[i]).stiffness();
            std::array<Pairs, n_pairs> matrix;
            for (unsigned int p = 0; p < n_pairs; ++p)
              for (unsigned int q = 0; q < n_pairs; ++q)
                matrix[p][q] = of[Symmetric::axes(p).first][Symmetric::axes(p).second]
                                 [Symmetric::axes(q).first][Symmetric::axes(q).second];
            solids.push_back(matrix);
            tensors.push_back(of);
            const auto held = solid_of(families->material[i]).stress_of_expansion();
            expansion.stress.emplace_back();
            for (unsigned int p = 0; p < n_pairs; ++p)
              expansion.stress.back()[p] = held[Symmetric::axes(p).first][Symmetric::axes(p).second];
            expansion.work.push_back(solid_of(families->material[i]).energy_of_expansion());
          }
        solid_of_node.push_back(inserted.first->second);
      }
  }

  template <int dim>
  void
  ConsistentOperator<dim>::take_expansion(const LocalIndex i, Pairs &stress, Pairs *const of_moment) const
  {
    const Pairs &held  = expansion.stress[solid_of_node[i]];
    const double share = bonds->share(i), work = expansion.work[solid_of_node[i]];
    const double volume = share * moments->cell_polynomials().volumes()[i];
    const double mean   = expansion.of_cells->mean[i];
    const auto  &moment = expansion.of_cells->moment[i];

    dealii::Tensor<2, dim> inverse;
    for (unsigned int p = 0; p < n_pairs; ++p)
      {
        const auto [a, b] = Symmetric::axes(p);
        inverse[a][b] = inverse[b][a] = inverse_moment[i][p];
      }
    const dealii::Tensor<1, dim> slope = inverse * moment;

    const auto times_held = [&](const NodeRecord *t) {
      double sum = 0;
      for (unsigned int p = 0; p < n_pairs; ++p)
        {
          const auto [a, b] = Symmetric::axes(p);
          sum += held[p] * (a == b ? t[a].value[a] : t[b].value[a] + t[a].value[b]);
        }
      return sum;
    };
    // Half of e^2 times the work less e eps:held, with e and eps linear in the cell.
    double energy = volume * mean * (mean * work - times_held(moments->gradient(i)));
    for (unsigned int k = 0; k < dim; ++k)
      energy += share * slope[k] * (moment[k] * work - times_held(moments->moment(i) + dim * k));
    expansion.energy += 0.5 * energy;

    for (unsigned int p = 0; p < n_pairs; ++p)
      {
        stress[p] -= volume * mean * held[p];
        for (unsigned int k = 0; k < dim; ++k)
          of_moment[k][p] -= moment[k] * held[p];
      }
  }

  template <int dim>
  void ConsistentOperator<dim>::set_moments()
  {
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        const auto inverse =
          invert(moments->cell_polynomials().second_moments()[i]) / moments->cell_polynomials().volumes()[i];
        Pairs pairs;
        for (unsigned int p = 0; p < n_pairs; ++p)
          pairs[p] = inverse[Symmetric::axes(p).first][Symmetric::axes(p).second];
        inverse_moment.push_back(pairs);
      }
  }

  template <int dim>
  std::vector<double> ConsistentOperator<dim>::dilatation() const
  {
    return dilatations;
  }

  template <int dim>
  std::size_t ConsistentOperator<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return bonds->memory_consumption() + memory_consumption(solid_of_node) +
           inverse_moment.size() * sizeof(Pairs) + moments->memory_consumption() +
           (deformed ? deformed->memory_consumption() : 0);
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentOperator)
} // namespace perideal
