// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/linear/family_operator.h>

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
    if (n_sums > 0 && !weights->kind.empty())
      make_kinds();
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  void FamilyOperator<dim, n_sums, own_force_weights, deformed>::make_kinds()
  {
    if constexpr (n_sums > 0)
      {
        kinds.resize(weights->stiffness.size(), NodeRecord{});
        for (std::size_t k = 0; k < kinds.size(); ++k)
          {
            double *value = kinds[k].value;
            value[0]      = weights->sum_weight[0].near[k];
            value[1]      = weights->sum_weight[0].far[k];
            if constexpr (n_sums == 2 || own_force_weights)
              {
                const auto &second = n_sums == 2 ? weights->sum_weight[n_sums - 1] : weights->force_weight[0];
                value[2]           = second.near[k];
                value[3]           = second.far[k];
              }
            else
              value[2] = weights->stiffness[k];
          }
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed>
  std::size_t FamilyOperator<dim, n_sums, own_force_weights, deformed>::memory_consumption() const
  {
    std::size_t bytes = weights->memory_consumption() +
                        (3 * positions.size() + kinds.size()) * sizeof(NodeRecord) +
                        2 * n_sums * families->n_local() * sizeof(double);
    if constexpr (deformed)
      bytes += 3 * deformation.scale.size() * sizeof(double);
    return bytes;
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template class FamilyOperator<dim, n_sums, own_force_weights, false>;                                      \
  template class FamilyOperator<dim, n_sums, own_force_weights, true>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
} // namespace perideal
