// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_body_forces_h
#define perideal_boundary_body_forces_h

#include <perideal/base/types.h>
#include <perideal/nodes/nodes.h>
#include <perideal/parameters/load_parameters.h>

namespace perideal
{
  /// Writes the body force times the volume of each node of a cell [N]; nodes behind those keep what they
  /// have.
  template <int dim>
  void
  set_body_forces(const Nodes<dim> &nodes, const Loads<dim> &loads, const double time, NodalVector &force);

  /// The integral of the body force over a cell [N], and that of its product with the distance from a point
  /// [N m].
  template <int dim>
  struct BodyForce
  {
    dealii::Tensor<1, dim> force;
    dealii::Tensor<2, dim> moment;
  };

  /// Integrates the body force over the cells of owned nodes by three Gauss points in each direction.
  /// @param about a point of each cell
  template <int dim>
  std::vector<BodyForce<dim>> integrate_body_forces(const Mesh<dim>                       &mesh,
                                                    const Nodes<dim>                      &nodes,
                                                    const std::vector<dealii::Point<dim>> &about,
                                                    const Loads<dim>                      &loads,
                                                    const double                           time);
} // namespace perideal

#endif
