// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_point_forces_h
#define perideal_boundary_point_forces_h

#include <perideal/base/types.h>
#include <perideal/mesh/mesh.h>
#include <perideal/parameters/load_parameters.h>
#include <perideal/reconstruction/point_interpolation.h>

namespace perideal
{
  /**
   * Forces at points of the body or its boundary, carried by the nodes around.
   *
   * The virtual work F v(x) of a force acts on the nodes that make v(x) (PointInterpolation). Linear fields
   * are reproduced, so that the nodes carry the force and its moment exactly, wherever it acts.
   */
  template <int dim>
  class PointForces
  {
  public:
    /// No forces.
    PointForces() = default;

    /// Collective.
    /// @throws InputError naming a point outside the body.
    PointForces(const Mesh<dim> &mesh, const CellGraph<dim> &graph, const Loads<dim> &loads);

    /// The same in a body whose displacement is means over cells.
    PointForces(const Mesh<dim> &mesh, const CellPolynomials<dim> &polynomials, const Loads<dim> &loads);

    /// Adds the forces [N] at a time to those on the owned nodes.
    void add(const Loads<dim> &loads, const double time, NodalVector &force) const;

  private:
    PointInterpolation<dim> carriers;
  };
} // namespace perideal

#endif
