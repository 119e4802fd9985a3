// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_vertex_displacement_h
#define perideal_problem_vertex_displacement_h

#include <perideal/nodes/mesh_points.h>
#include <perideal/problem/problem.h>

#include <memory>
#include <vector>

namespace perideal
{
  /// Makes the points at which the cells of a problem meet. Collective.
  template <int dim>
  std::unique_ptr<MeshPoints<dim>> make_mesh_points(const Problem<dim> &problem);

  /// Opens the points where precracks run and bonds between cells that share a face are broken. Collective.
  template <int dim>
  void open_cracks(const Problem<dim> &problem, MeshPoints<dim> &points);

  /**
   * Returns the displacement at the corners of the owned cells, rigid-body motions removed [m], one value for
   * all cells that meet at a point: the mean of what the cells have there, by their polynomials in the
   * consistent form, and by linear fits to the nodes around in all other forms and beside cracks that have
   * grown. Collective.
   * @param points with their cracks open
   */
  template <int dim>
  std::vector<CornerValues<dim>> vertex_displacement(const Problem<dim>    &problem,
                                                     const MeshPoints<dim> &points);
} // namespace perideal

#endif
