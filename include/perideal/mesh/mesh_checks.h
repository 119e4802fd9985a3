// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_mesh_checks_h
#define perideal_mesh_mesh_checks_h

#include <perideal/base/exceptions.h>
#include <perideal/mesh/coarse_mesh.h>

namespace perideal
{
  template <int dim>
  using CoarseCell = typename dealii::Triangulation<dim>::cell_iterator;

  /// Names a cell by its number in the mesh file, or by its index, and its place.
  template <int dim>
  std::string in_words(const CoarseMesh<dim> &mesh, const CoarseCell<dim> &cell);

  /// An error about a mesh, with its file or generator.
  template <int dim>
  InputError mesh_error(const CoarseMesh<dim> &mesh, const std::string &problem);

  /// A normal of a face at its centre: the tangent turned, or the product of the diagonals.
  template <int dim>
  dealii::Tensor<1, dim> face_normal(const CoarseCell<dim> &cell, const unsigned int f);

  /**
   * Refuses meshes that deal.II's Release build and p4est would accept
   * without a message, with wrong results or a crash: cells that are collapsed,
   * folded, not convex or flat (the Jacobian must be positive at every corner),
   * cells that lie on one another, parts that are not joined where they meet
   * (see check_joints()), and boundary groups with faces that are not sides of
   * a cell on the surface.
   *
   * @throws InputError naming the first such cell.
   */
  template <int dim>
  void check_coarse_mesh(const CoarseMesh<dim> &mesh);

  /**
   * Refuses meshes whose parts look like one body and are none: two nodes at
   * one place, or parts that no face joins and that overlap.
   *
   * @throws InputError with their number and the first of them.
   */
  template <int dim>
  void check_joints(const CoarseMesh<dim> &mesh);

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
