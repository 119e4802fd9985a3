// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_nodal_springs_h
#define perideal_operators_linear_nodal_springs_h

#include <perideal/operators/linear/bond_operator.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// Bonds with a spring between each component of a node and its place at rest.
  template <int dim>
  class NodalSprings : public BondOperator<dim>
  {
  public:
    /// @param stiffness by dim*node + component of the first nodes of this rank [N/m]
    NodalSprings(const std::shared_ptr<const BondOperator<dim>> &bonds, const std::vector<double> &stiffness);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    void internal_force(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    void assemble(const typename BondOperator<dim>::AddBlock &add) const override;

    void visit_bond_forces(const typename BondOperator<dim>::VisitBond &visit) const override
    {
      bonds->visit_bond_forces(visit);
    }
    std::vector<double> dilatation() const override { return bonds->dilatation(); }
    bool                is_symmetric() const override { return bonds->is_symmetric(); }
    std::size_t         memory_consumption() const override;

  private:
    void add_springs(NodalVector &force, const NodalVector &displacement) const;

    std::shared_ptr<const BondOperator<dim>> bonds;
    std::vector<double>                      stiffness;
  };
} // namespace perideal

#endif
