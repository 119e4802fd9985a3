// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/family_operator.h>

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  FamilyOperator<dim, n_sums, own_force_weights, deformed>::FamilyOperator(
    const std::shared_ptr<const FamilyWeights<dim, n_sums, own_force_weights>> &weights)
    : weights(weights)
    , families(weights->families)
  {
    this->counts      = weights->counts;
    this->reports     = weights->reports;
    this->partitioner = families->make_partitioner(dim);
    ghosted.reinit(this->partitioner);
    if (n_sums > 0)
      ghosted_states.reinit(families->make_partitioner(n_sums));

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

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  std::size_t FamilyOperator<dim, n_sums, own_force_weights, deformed>::memory_consumption() const
  {
    std::size_t bytes = weights->memory_consumption() + 3 * positions.size() * sizeof(NodeRecord) +
                        2 * n_sums * families->n_local() * sizeof(double);
    if constexpr (deformed)
      bytes += 3 * deformation.scale.size() * sizeof(double);
    return bytes;
  }

#define PERIDEAL_INSTANTIATE(dim, n_sums, own_force_weights)                                                 \
  template class FamilyOperator<dim, n_sums, own_force_weights, false>;                                      \
  template class FamilyOperator<dim, n_sums, own_force_weights, true>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE)
#undef PERIDEAL_INSTANTIATE
} // namespace perideal
