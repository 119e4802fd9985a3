// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/node_partitioner.h>
#include <perideal/operators/system/constrained_operator.h>

#include <algorithm>

namespace perideal
{
  template <int dim>
  ConstrainedOperator<dim>::ConstrainedOperator(const std::shared_ptr<const BondOperator<dim>> &bonds,
                                                const std::shared_ptr<const MirrorLayer<dim>>  &mirror,
                                                const NodeCloud<dim>                           &nodes,
                                                const std::vector<std::uint8_t>                &held)
    : bonds(bonds)
    , mirror(mirror)
    , held(held)
    , first_global_node(nodes.first_global)
    , n_global_nodes(nodes.n_global)
  {
    AssertDimension(held.size(), static_cast<std::size_t>(dim) * nodes.size());
    partitioner =
      make_node_partitioner(nodes.first_global, nodes.size(), nodes.n_global, {}, dim, nodes.communicator);
    masked.reinit(partitioner);
    bonds->initialize(extended);
    bonds->initialize(force);
  }

  template <int dim>
  void ConstrainedOperator<dim>::vmult(NodalVector &destination, const NodalVector &source) const
  {
    for (std::size_t i = 0; i < held.size(); ++i)
      masked.local_element(i) = held[i] ? 0. : source.local_element(i);
    mirror->extend(masked, false, extended);
    bonds->vmult(force, extended);
    for (std::size_t i = 0; i < held.size(); ++i)
      destination.local_element(i) = held[i] ? source.local_element(i) : force.local_element(i);
    for (std::size_t i = 0; i < anchors.size(); ++i)
      if (!held[i])
        destination.local_element(i) += anchors[i] * source.local_element(i);
  }

  template <int dim>
  void ConstrainedOperator<dim>::internal_force(NodalVector       &force_on_all,
                                                const NodalVector &displacement) const
  {
    mirror->extend(displacement, true, extended);
    bonds->internal_force(force_on_all, extended);
  }

  template <int dim>
  void ConstrainedOperator<dim>::residual(NodalVector       &result,
                                          const NodalVector &external_force,
                                          const NodalVector &displacement) const
  {
    internal_force(force, displacement);
    for (std::size_t i = 0; i < held.size(); ++i)
      result.local_element(i) = held[i] ? 0. : external_force.local_element(i) - force.local_element(i);
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> ConstrainedOperator<dim>::jacobi_blocks() const
  {
    auto blocks = bonds->jacobi_blocks();
    blocks.resize(n_nodes());
    for (std::size_t i = 0; i < anchors.size(); ++i)
      blocks[i / dim][i % dim][i % dim] += anchors[i];
    for (LocalIndex i = 0; i < n_nodes(); ++i)
      for (int d = 0; d < dim; ++d)
        if (held[dim * i + d])
          for (int e = 0; e < dim; ++e)
            if (e != d)
              blocks[i][d][e] = blocks[i][e][d] = 0.;
    return blocks;
  }

  PERIDEAL_INSTANTIATE_CLASS(ConstrainedOperator)
} // namespace perideal
