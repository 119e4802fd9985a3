// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_tangent_operator_h
#define perideal_operators_linear_tangent_operator_h

#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/linear/bond_operator.h>

#include <memory>

namespace perideal
{
  /// How bonds that soften are linearised.
  enum class Slope
  {
    /// What they have left, as it is: positive definite, and symmetric where the model is.
    secant,
    /// As they go on to soften, too.
    tangent
  };

  /**
   * Applies the derivative of a BondForce with respect to the displacement (PDBC eq. B.4), with the sign of a
   * resisting force, in closed form and matrix-free. With p = (|xi|/|y_j - y_i|) (y_j - y_i), the
   * magnitude m = sum_a weight[a]_j A_a + stiffness eps and g = m |xi|/|y_j - y_i|, a bond's force m p
   * changes under d u by
   *
   *     dF = ( sum_a weight[a]_j dA_a + k' p.(du_j - du_i) ) p + g (du_j - du_i),   k' = stiffness -
   * g/|xi|^2,
   *
   * where the sums of families change by d s_a = sum_j sum[a]_j p.(du_j - du_i). Bonds that were cut or
   * broke carry nothing. A bond that softens adds m dg/deps/g p.(du_j - du_i) p with the share g of its
   * weights that is left; the sums of its families, which have g of it, change by g + eps dg/deps of its
   * p.(du_j - du_i). So the tangent of a model with sums is not symmetric while bonds soften: that bond
   * counts less in its neighbours' forces, but they do not count less in its own. Bond tensors have the
   * secant alone.
   *
   * The weights are in double precision, those of the force in single: the tangent is exact up to the
   * rounding of the latter.
   */
  template <int dim>
  class TangentOperator : public BondOperator<dim>
  {
  public:
    /// Takes the state of the last compute() of the force, which is of the same weights. Until the first
    /// call the body is at rest and has all its bonds.
    virtual void linearise(const BondForce<dim> &force, const Slope slope = Slope::tangent) = 0;

    /// Adds the force [N] by what prescribed face values, which the operator itself carries, have still to
    /// move; nothing where it carries none. Collective.
    virtual void add_increments(NodalVector &) const {}
  };

  /// The tangent of the force of weighed bonds, which it shares.
  template <int dim>
  std::unique_ptr<TangentOperator<dim>>
  create_tangent(const std::shared_ptr<const BondWeights<dim>> &weights);
} // namespace perideal

#endif
