// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_block_jacobi_h
#define perideal_operators_system_block_jacobi_h

#include <perideal/operators/system/constrained_operator.h>

#include <vector>

namespace perideal
{
  /// Inverts the dim x dim diagonal blocks of the operator, the sums over
  /// families (dilatation) included.
  template <int dim>
  class BlockJacobi
  {
  public:
    /// @throws ComputationError when a block is singular, naming the node.
    explicit BlockJacobi(const ConstrainedOperator<dim> &system);

    /// Every result is multiplied by @p factor from now on.
    void set_damping(const double factor) { damping = factor; }

    void vmult(NodalVector &destination, const NodalVector &source) const;

  private:
    std::vector<dealii::Tensor<2, dim>> inverse;
    double                              damping = 1.;
  };
} // namespace perideal

#endif
