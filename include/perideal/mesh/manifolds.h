// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_manifolds_h
#define perideal_mesh_manifolds_h

#include <perideal/mesh/coarse_mesh.h>

namespace perideal
{
  /**
   * Makes refinement and higher-order mappings follow the cylinders: faces of
   * each such boundary (and their edges) get a polar or cylindrical manifold,
   * whose id is the boundary id. Everything else stays flat. The triangulation
   * must not be refined yet.
   */
  template <int dim>
  void attach_manifolds(const Cylinders &cylinders, dealii::Triangulation<dim> &triangulation);

  /// @throws InputError when the vertices of a boundary in mesh.cylinders do
  /// not have one distance from its axis, to 1e-6 of it.
  template <int dim>
  void check_cylinders(const CoarseMesh<dim> &mesh);
} // namespace perideal

#endif
