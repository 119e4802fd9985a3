// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_surface_planes_h
#define perideal_boundary_surface_planes_h

#include <perideal/boundary/boundary_faces.h>

#include <array>
#include <functional>
#include <vector>

namespace perideal
{
  /// A piece of the body's surface that the horizon of a node reaches, as the plane of its nearest face.
  template <int dim>
  struct SurfacePlane
  {
    dealii::types::boundary_id boundary;
    /// Centre of the nearest face [m], unit outward normal.
    dealii::Point<dim>     point;
    dealii::Tensor<1, dim> normal;
    /// How deep the node lies below the plane [m].
    double depth;
  };

  /// What of a boundary face its neighbourhood wants to know, wherever it lies.
  template <int dim>
  struct SurfaceFace
  {
    dealii::types::boundary_id boundary;
    dealii::Point<dim>         centre;
    dealii::Tensor<1, dim>     normal;
    /// Measure [m^2], and largest distance of a corner from the centre [m].
    double area, radius;
    /// Corners, ordered as deal.II's.
    std::array<dealii::Point<dim>, 1u << (dim - 1)> vertices;
  };

  /// The boundary faces of all ranks, in the same order on each. Collective.
  template <int dim>
  std::vector<SurfaceFace<dim>> gather_faces(const std::vector<BoundaryFace<dim>> &faces,
                                             MPI_Comm                              communicator);

  /// Calls for every owned node with the faces that its horizon may reach, nearest centre first.
  /// @param horizons how many horizons away faces may be
  template <int dim>
  void visit_nearby_faces(
    const NodeCloud<dim>                                                                       &nodes,
    const std::vector<SurfaceFace<dim>>                                                        &faces,
    const std::function<void(const LocalIndex, const std::vector<const SurfaceFace<dim> *> &)> &visit,
    const double horizons = 1.);

  /**
   * The planes of the surface near each owned node: a face whose normal differs by more than 30 degrees from
   * those nearer by makes a plane of its own. Near a curved surface that is one plane, the tangent at the
   * nearest face; at an edge two, at a corner three.
   */
  template <int dim>
  std::vector<std::vector<SurfacePlane<dim>>> find_surface_planes(const NodeCloud<dim>                &nodes,
                                                                  const std::vector<SurfaceFace<dim>> &faces);
} // namespace perideal

#endif
