// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_tensor_operator_h
#define perideal_operators_linear_tensor_operator_h

#include <perideal/base/lanes.h>
#include <perideal/operators/linear/bond_operator.h>
#include <perideal/operators/weights/tensor_weights.h>

#include <deal.II/base/aligned_vector.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// Applies the linear force of models with bond tensors: each bond once, F = tensor (u_j - u_i).
  template <int dim>
  class TensorOperator : public BondOperator<dim>
  {
  public:
    explicit TensorOperator(const std::shared_ptr<const TensorWeights<dim>> &weights);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    void assemble(const typename BondOperator<dim>::AddBlock &add) const override;
    void visit_bond_forces(const typename BondOperator<dim>::VisitBond &visit) const override;

    /// The model has no such sums.
    std::vector<double> dilatation() const override { return std::vector<double>(families->n_owned(), 0.); }
    bool                is_symmetric() const override { return weights->symmetric; }
    std::size_t         memory_consumption() const override;

  private:
    void sum_forces() const;

    std::shared_ptr<const TensorWeights<dim>> weights;
    std::shared_ptr<const Families<dim>>      families;

    // Work space of vmult().
    mutable dealii::AlignedVector<NodeRecord> displacements, forces;
    mutable NodalVector                       ghosted;
  };
} // namespace perideal

#endif
