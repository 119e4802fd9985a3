// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/force/family_force.h>
#include <perideal/operators/force/tensor_force.h>

#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

// Set-up of FamilyForce.

namespace perideal
{
  template <int dim, unsigned int n_sums, bool own_force_weights>
  FamilyForce<dim, n_sums, own_force_weights>::FamilyForce(const Weights &from)
    : BreakingBonds<dim>(from.families, from.bonds, n_sums > 0)
  {
    FamilyForce::take_weights(from, {});
    if (n_sums > 0)
      ghosted_states.reinit(families->make_partitioner(n_sums));
    for (unsigned int a = 0; a < n_sums; ++a)
      {
        sums[a].resize(families->n_local());
        state[a].resize(families->n_local());
      }
  }

  template <int dim, unsigned int n_sums, bool own_force_weights>
  std::size_t FamilyForce<dim, n_sums, own_force_weights>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return this->breaking_memory() + weights.weights_memory() + memory_consumption(map.entries) +
           memory_consumption(energy) + 2 * n_sums * families->n_local() * sizeof(double) +
           ghosted_states.memory_consumption();
  }

  template <int dim>
  std::unique_ptr<BondForce<dim>> create_bond_force(const BondWeights<dim> &weights)
  {
    if (weights.shape.bond_tensors)
      return std::make_unique<TensorForce<dim>>(static_cast<const TensorWeights<dim> &>(weights));
    return visit_family_shape(weights.shape,
                              [&](const auto n_sums, const auto own) -> std::unique_ptr<BondForce<dim>> {
                                return std::make_unique<FamilyForce<dim, n_sums, own>>(
                                  static_cast<const FamilyWeights<dim, n_sums, own> &>(weights));
                              });
  }

#define PERIDEAL_INSTANTIATE_SHAPE(dim, n_sums, own_force_weights)                                           \
  template class FamilyForce<dim, n_sums, own_force_weights>;
  PERIDEAL_FOR_FAMILY_SHAPES(PERIDEAL_INSTANTIATE_SHAPE)
#undef PERIDEAL_INSTANTIATE_SHAPE
  PERIDEAL_INSTANTIATE(create_bond_force)
} // namespace perideal
