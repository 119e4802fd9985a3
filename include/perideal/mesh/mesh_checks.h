// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_mesh_checks_h
#define perideal_mesh_mesh_checks_h

#include <perideal/mesh/coarse_mesh.h>

namespace perideal
{
  /**
   * Refuses meshes that deal.II's Release build and p4est would accept
   * without a message, with wrong results or a crash: cells that are collapsed,
   * folded, not convex or flat (the Jacobian must be positive at every corner),
   * cells that lie on one another, and boundary groups with faces that are not
   * sides of a cell on the surface.
   *
   * @throws InputError naming the first such cell.
   */
  template <int dim>
  void check_coarse_mesh(const CoarseMesh<dim> &mesh);

  /**
   * Refuses cells that refinement has folded, since it moves vertices to curved
   * boundaries. Collective; @p origin is the mesh file or the generator.
   *
   * @throws InputError naming the first such cell.
   */
  template <int dim>
  void check_refined_mesh(const dealii::Triangulation<dim> &triangulation, const std::string &origin);
} // namespace perideal

#endif
