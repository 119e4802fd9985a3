// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_post_partial_stress_h
#define perideal_operators_post_partial_stress_h

#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/linear/bond_operator.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace perideal
{
  /**
   * Computes the areal force density of the bonds between nodes, as a tensor P with tau = P n (first
   * Piola-Kirchhoff), by owned node of the families [Pa]:
   *
   *     P_i = 1/(2 V_i) sum_j F_ij (x) xi_ij,
   *
   * F_ij the force on i through the bond to j, xi_ij = x_j - x_i. The bonds of a homogeneous body that pass
   * through a plane leave from a line of points along its normal; a bond of a normal length q does so from a
   * length q of it, which with both directions of the bond gives the half of the sum. On a lattice it is the
   * sum of QUAD (2.12) over nodes with the trapezoidal rule along the line, those in the plane counted half.
   *
   * Of a uniform strain it is the stress C : eps as far as the bonds of whole families two horizons around
   * are; bonds with tensors have S : grad u instead (materials/tensor_involved.h), which differs from it
   * where C is not symmetric in all its indices.
   */
  template <int dim, typename Bonds>
  std::vector<dealii::Tensor<2, dim>> partial_stress(const Families<dim> &families, const Bonds &bonds);

  /// Of the last vmult().
  extern template std::vector<dealii::Tensor<2, 2>> partial_stress(const Families<2> &,
                                                                   const BondOperator<2> &);
  extern template std::vector<dealii::Tensor<2, 3>> partial_stress(const Families<3> &,
                                                                   const BondOperator<3> &);
  /// Of the last compute().
  extern template std::vector<dealii::Tensor<2, 2>> partial_stress(const Families<2> &, const BondForce<2> &);
  extern template std::vector<dealii::Tensor<2, 3>> partial_stress(const Families<3> &, const BondForce<3> &);
} // namespace perideal

#endif
