// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/family_operator.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

// Set-up of FamilyOperator: every family is weighed once.

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights>
  FamilyOperator<dim, n_sums, own_force_weights>::FamilyOperator(
    const std::shared_ptr<const Families<dim>>                    &families,
    LinearModel<dim>                                              &model,
    const std::function<Moduli(const dealii::types::material_id)> &moduli)
    : families(families)
    , bonds(*families)
    , symmetric(model.is_symmetric())
  {
    this->partitioner = families->make_partitioner(dim);
    state_partitioner = families->make_partitioner(n_sums);
    ghosted.reinit(this->partitioner);
    ghosted_states.reinit(state_partitioner);
    weigh_families(model, moduli);

    positions.resize(families->n_local(), NodeRecord{});
    displacements.resize(families->n_local(), NodeRecord{});
    forces.resize(families->n_local(), NodeRecord{});
    for (LocalIndex i = 0; i < families->n_local(); ++i)
      for (int d = 0; d < dim; ++d)
        positions[i].value[d] = families->position[i][d];
    for (unsigned int a = 0; a < n_sums; ++a)
      {
        sums[a].resize(families->n_local());
        state[a].resize(families->n_local());
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyOperator<dim, n_sums, own_force_weights>::weigh_families(
    LinearModel<dim> &model, const std::function<Moduli(const dealii::types::material_id)> &moduli)
  {
    const BondIndex n = bonds.n_slots();
    stiffness.assign(n, 0.);
    for (Weights *weights : {&sum_weight, &force_weight})
      if (weights == &sum_weight || own_force_weights)
        for (Ends &ends : *weights)
          {
            ends.near.assign(n, 0.);
            ends.far.assign(n, 0.);
          }
    map.resize(families->n_local());
    this->reports.resize(families->n_owned());

    BondCursor                   cursor(bonds);
    std::vector<BondCursor::End> ends;
    FamilyView<dim>              view;
    FamilyCoefficients           coefficients;
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      {
        view.reinit(*families, i);
        const Moduli material = moduli(families->material[i]);
        view.bulk_modulus     = material.bulk_modulus;
        view.shear_modulus    = material.shear_modulus;
        coefficients.resize(view.size, model.shape());
        model.compute(view, coefficients);
        cursor.find(i, families->begin(i), families->end(i), ends);
        store(i, coefficients, ends);
      }

    // The far ends of cut bonds, and the maps of ghosts, come from their owners.
    std::vector<double>         far_stiffness(n, 0.);
    std::vector<const double *> near = {stiffness.data()};
    std::vector<double *>       far  = {far_stiffness.data()};
    for (Weights *weights : {&sum_weight, &force_weight})
      if (weights == &sum_weight || own_force_weights)
        for (Ends &end_values : *weights)
          {
            near.push_back(end_values.near.data());
            far.push_back(end_values.far.data());
          }
    exchange_cut_bonds(*families, bonds, near, far);
    for (BondIndex slot = 0; slot < n; ++slot)
      stiffness[slot] += far_stiffness[slot];

    NodalVector maps(families->make_partitioner(3));
    for (LocalIndex i = 0; i < families->n_owned(); ++i)
      for (unsigned int k = 0; k < 3; ++k)
        maps.local_element(3 * i + k) = map[i][k];
    maps.update_ghost_values();
    for (LocalIndex i = families->n_owned(); i < families->n_local(); ++i)
      for (unsigned int k = 0; k < 3; ++k)
        map[i][k] = maps.local_element(3 * i + k);

    for (const FamilyReport &report : this->reports)
      {
        this->counts.fallback += report.fallback;
        this->counts.singular += report.singular;
        this->counts.indefinite += report.indefinite;
      }
    for (GlobalIndex *count : {&this->counts.fallback, &this->counts.singular, &this->counts.indefinite})
      *count = dealii::Utilities::MPI::sum(*count, families->communicator);
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  void FamilyOperator<dim, n_sums, own_force_weights>::store(const LocalIndex                    i,
                                                             const FamilyCoefficients           &coefficients,
                                                             const std::vector<BondCursor::End> &ends)
  {
    map[i]           = coefficients.map;
    this->reports[i] = coefficients.report;
    for (std::size_t k = 0; k < ends.size(); ++k)
      {
        const BondCursor::End end = ends[k];
        stiffness[end.slot] += coefficients.stiffness[k];
        for (unsigned int a = 0; a < n_sums; ++a)
          {
            (end.is_near ? sum_weight[a].near : sum_weight[a].far)[end.slot] = coefficients.sum[a][k];
            if constexpr (own_force_weights)
              (end.is_near ? force_weight[a].near : force_weight[a].far)[end.slot] =
                coefficients.force_weight[a][k];
          }
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  std::size_t FamilyOperator<dim, n_sums, own_force_weights>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    std::size_t bytes = bonds.memory_consumption() + memory_consumption(stiffness) +
                        map.size() * sizeof(map[0]) + 3 * positions.size() * sizeof(NodeRecord) +
                        2 * n_sums * families->n_local() * sizeof(double);
    for (unsigned int a = 0; a < n_sums; ++a)
      bytes += memory_consumption(sum_weight[a].near) + memory_consumption(sum_weight[a].far) +
               memory_consumption(force_weight[a].near) + memory_consumption(force_weight[a].far);
    return bytes;
  }
#define PERIDEAL_INSTANTIATE(dim, n_sums, own_force_weights)                                                 \
  template class FamilyOperator<dim, n_sums, own_force_weights>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE)
#undef PERIDEAL_INSTANTIATE
} // namespace perideal
