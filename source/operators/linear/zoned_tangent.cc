// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/zoned_tangent.h>

namespace perideal
{
  template <int dim>
  ZonedTangent<dim>::ZonedTangent(const std::shared_ptr<ConsistentOperator<dim>> &cells)
    : cells(cells)
  {
    this->counts  = cells->counts;
    this->reports = cells->reports;
    cells->initialize(of_bonds);
    this->partitioner = of_bonds.get_partitioner();
  }

  template <int dim>
  void ZonedTangent<dim>::linearise(const BondForce<dim> &force, const Slope slope)
  {
    const auto *from = dynamic_cast<const ZonedForce<dim> *>(&force);
    AssertThrow(from != nullptr, dealii::ExcInternalError());
    cells->linearise(from->cell_force(), slope);
    const FractureZone<dim> &zone = from->fracture_zone();
    if (!zone.is_there())
      return;
    if (!bonds || version != zone.version())
      {
        bonds   = create_tangent<dim>(from->scaled_weights());
        version = zone.version();
      }
    bonds->linearise(from->bond_force(), slope);
  }

  template <int dim>
  void ZonedTangent<dim>::add_bonds(NodalVector &force, const NodalVector &displacement) const
  {
    if (!bonds)
      return;
    bonds->vmult(of_bonds, displacement);
    force += of_bonds;
  }

  template <int dim>
  void ZonedTangent<dim>::vmult(NodalVector &force, const NodalVector &displacement) const
  {
    cells->vmult(force, displacement);
    add_bonds(force, displacement);
  }

  template <int dim>
  void ZonedTangent<dim>::internal_force(NodalVector &force, const NodalVector &displacement) const
  {
    cells->internal_force(force, displacement);
    add_bonds(force, displacement);
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> ZonedTangent<dim>::jacobi_blocks() const
  {
    auto result = cells->jacobi_blocks();
    if (bonds)
      {
        const auto blocks = bonds->jacobi_blocks();
        for (std::size_t i = 0; i < result.size(); ++i)
          result[i] += blocks[i];
      }
    return result;
  }

  template <int dim>
  void ZonedTangent<dim>::assemble(const AddBlock &add) const
  {
    cells->assemble(add);
    if (bonds)
      bonds->assemble(add);
  }

  template <int dim>
  std::size_t ZonedTangent<dim>::memory_consumption() const
  {
    return cells->memory_consumption() + (bonds ? bonds->memory_consumption() : 0) +
           of_bonds.memory_consumption();
  }

  PERIDEAL_INSTANTIATE_CLASS(ZonedTangent)
} // namespace perideal
