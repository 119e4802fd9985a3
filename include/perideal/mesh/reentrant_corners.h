// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_reentrant_corners_h
#define perideal_mesh_reentrant_corners_h

#include <perideal/mesh/mesh.h>

#include <array>
#include <vector>

namespace perideal
{
  /// A corner of a plane body, in 3-D an edge, into which no material reaches.
  template <int dim>
  struct ReentrantCorner
  {
    /// The corner; the ends of the edge [m].
    std::array<dealii::Point<dim>, dim - 1> ends;
    /// That the material fills, above pi [rad].
    double angle;
  };

  /// Returns the re-entrant corners of the coarse mesh, on each rank all of them. Angles below 7/6 pi count
  /// as those of a curved surface of straight faces, and so do all along curved boundaries (Mesh::cylinders).
  template <int dim>
  std::vector<ReentrantCorner<dim>> reentrant_corners(const Mesh<dim> &mesh);

  /// Returns p of the strains r^-p at a distance r from a corner, 1/2 at the tip of a crack and 0 where the
  /// surface is smooth: of 1 - p = q, the smaller root of sin(q angle) + q sin(angle) = 0 (symmetric motions;
  /// Williams, Journal of Applied Mechanics 19, 526-528, 1952).
  /// @param angle that the material fills, pi to 2 pi [rad]
  double singular_exponent(const double angle);
} // namespace perideal

#endif
