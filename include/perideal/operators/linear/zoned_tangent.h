// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_zoned_tangent_h
#define perideal_operators_linear_zoned_tangent_h

#include <perideal/operators/force/zoned_force.h>
#include <perideal/operators/linear/consistent_operator.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// Applies the derivative of a ZonedForce: that of its cells and that of its bonds.
  template <int dim>
  class ZonedTangent : public TangentOperator<dim>
  {
  public:
    /// @param cells the operator of the cells, which shares their bonds with the force
    explicit ZonedTangent(const std::shared_ptr<ConsistentOperator<dim>> &cells);

    /// @param force a ZonedForce of the same cells
    void linearise(const BondForce<dim> &force, const Slope slope = Slope::tangent) override;

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    void internal_force(NodalVector &force, const NodalVector &displacement) const override;
    void add_increments(NodalVector &force) const override { cells->add_increments(force); }
    std::vector<dealii::Tensor<1, dim>> support_forces() const override { return cells->support_forces(); }
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    void                                assemble(const AddBlock &add) const override;
    std::vector<double>                 dilatation() const override { return cells->dilatation(); }
    bool        is_symmetric() const override { return !bonds || bonds->is_symmetric(); }
    std::size_t memory_consumption() const override;

  private:
    void add_bonds(NodalVector &force, const NodalVector &displacement) const;

    std::shared_ptr<ConsistentOperator<dim>> cells;
    /// Null as long as no bond counts.
    std::unique_ptr<TangentOperator<dim>> bonds;
    unsigned int                          version = 0;
    mutable NodalVector                   of_bonds;
  };
} // namespace perideal

#endif
