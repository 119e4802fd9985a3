// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/nodal_springs.h>

#include <deal.II/base/memory_consumption.h>

namespace perideal
{
  template <int dim>
  NodalSprings<dim>::NodalSprings(const std::shared_ptr<const BondOperator<dim>> &bonds,
                                  const std::vector<double>                      &stiffness)
    : bonds(bonds)
    , stiffness(stiffness)
  {
    this->counts  = bonds->counts;
    this->reports = bonds->reports;
    NodalVector layout;
    bonds->initialize(layout);
    this->partitioner = layout.get_partitioner();
    Assert(stiffness.size() <= layout.locally_owned_size(), dealii::ExcInternalError());
  }

  template <int dim>
  void NodalSprings<dim>::add_springs(NodalVector &force, const NodalVector &displacement) const
  {
    for (std::size_t i = 0; i < stiffness.size(); ++i)
      force.local_element(i) += stiffness[i] * displacement.local_element(i);
  }

  template <int dim>
  void NodalSprings<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    bonds->vmult(force, displacement);
    add_springs(force, displacement);
  }

  template <int dim>
  void NodalSprings<dim>::internal_force(NodalVector &force, const NodalVector &displacement) const
  {
    bonds->internal_force(force, displacement);
    add_springs(force, displacement);
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> NodalSprings<dim>::jacobi_blocks() const
  {
    auto result = bonds->jacobi_blocks();
    for (std::size_t i = 0; i < stiffness.size(); ++i)
      result[i / dim][i % dim][i % dim] += stiffness[i];
    return result;
  }

  template <int dim>
  void NodalSprings<dim>::assemble(const typename BondOperator<dim>::AddBlock &add) const
  {
    bonds->assemble(add);
    const GlobalIndex first = this->partitioner->local_range().first;
    for (std::size_t i = 0; i < stiffness.size(); ++i)
      add({first + i}, {stiffness[i]});
  }

  template <int dim>
  std::size_t NodalSprings<dim>::memory_consumption() const
  {
    return bonds->memory_consumption() + dealii::MemoryConsumption::memory_consumption(stiffness);
  }

  PERIDEAL_INSTANTIATE_CLASS(NodalSprings)
} // namespace perideal
