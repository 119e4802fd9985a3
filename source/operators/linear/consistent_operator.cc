// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/record_exchange.h>
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
                                              const Consistent<dim>                             &model,
                                              const SolidOf<dim>                                &solid_of)
    : families(families)
    , moments(moments)
    , model(model)
    , bonds(*families)
  {
    const LocalIndex n_owned = families->n_owned(), n_local = families->n_local();
    this->partitioner = families->make_partitioner(dim);
    of_states         = families->make_partitioner(4 * n_records);
    work.states.resize(n_records * n_local, NodeRecord{});
    work.forces.resize(n_local, NodeRecord{});
    work.stresses.resize(n_parts * n_local, NodeRecord{});
    work.dilatation.resize(n_owned);

    // Centroids of the ghosts, which their owners know.
    const auto &centroids = moments->cell_polynomials().centroids();
    for (LocalIndex i = 0; i < n_owned; ++i)
      for (int d = 0; d < dim; ++d)
        work.states[n_records * i].value[d] = centroids[i][d];
    update_ghosts(*of_states, work.states, work.temporary);
    positions.resize(n_local, NodeRecord{});
    for (LocalIndex i = 0; i < n_local; ++i)
      positions[i] = work.states[n_records * i];

    set_solids(solid_of);
    set_moments();
    weigh_bonds(solid_of);

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
  void ConsistentOperator<dim>::weigh_bonds(const SolidOf<dim> &solid_of)
  {
    stiffness.assign(bonds.n_slots(), 0.);
    std::map<dealii::types::material_id, double> modulus_of;
    for (const auto id : families->material)
      if (modulus_of.count(id) == 0)
        modulus_of[id] = Consistent<dim>::stabilising_modulus(solid_of(id));
    const auto distance_square = [&](const LocalIndex m, const dealii::Tensor<1, dim> &bond) {
      return families->shape.empty() ? bond.norm_square() / (families->horizon[m] * families->horizon[m]) :
                                       (families->shape[m] * bond).norm_square();
    };
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (BondIndex k = bonds.row[i]; k < bonds.row[i + 1]; ++k)
        {
          const LocalIndex j = bonds.neighbour[k];
          if (j == i || families->material[j] != families->material[i])
            continue;
          const auto   bond          = families->position[j] - families->position[i];
          const double length_square = bond.norm_square(), modulus = modulus_of[families->material[i]];
          stiffness[k] =
            model.bond_stiffness(length_square, distance_square(i, bond), families->volume[j], modulus) +
            model.bond_stiffness(length_square, distance_square(j, bond), families->volume[i], modulus);
        }
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
          }
        solid_of_node.push_back(inserted.first->second);
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
    return work.dilatation;
  }

  template <int dim>
  std::size_t ConsistentOperator<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return bonds.memory_consumption() + memory_consumption(stiffness) + memory_consumption(solid_of_node) +
           inverse_moment.size() * sizeof(Pairs) +
           (positions.size() + work.states.size() + work.forces.size() + work.stresses.size()) *
             sizeof(NodeRecord) +
           moments->memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(ConsistentOperator)
} // namespace perideal
