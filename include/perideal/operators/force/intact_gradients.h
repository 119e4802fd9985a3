// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_intact_gradients_h
#define perideal_operators_force_intact_gradients_h

#include <perideal/operators/force/bond_force.h>

#include <vector>

namespace perideal
{
  /// Returns the displacement by local component, of ghosts too, at the last compute() of a force [m].
  template <int dim>
  NodalVector displacement_of(const Families<dim> &families, const BondForce<dim> &force);

  /// Returns (d u_a/d x_b) of owned nodes by FamilyQuadratics over those of their bonds that neither broke
  /// nor softened: along the others the displacement jumps.
  /// @param displacement as FamilyQuadratics takes it [m]
  template <int dim>
  std::vector<dealii::Tensor<2, dim>> intact_gradients(const Families<dim>           &families,
                                                       const BondForce<dim>          &force,
                                                       const NodalVector             &displacement,
                                                       const std::vector<LocalIndex> &nodes);
} // namespace perideal

#endif
