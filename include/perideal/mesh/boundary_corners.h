// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_boundary_corners_h
#define perideal_mesh_boundary_corners_h

#include <perideal/mesh/mesh.h>

#include <deal.II/base/numbers.h>

#include <array>
#include <vector>

namespace perideal
{
  /// Where two faces of a boundary meet: a corner of a plane body, an edge of a solid.
  template <int dim>
  struct BoundaryCorner
  {
    struct Side
    {
      dealii::types::boundary_id boundary;
      /// Unit vector out of the body.
      dealii::Tensor<1, dim> normal;
    };

    /// The corner; the ends of the edge [m].
    std::array<dealii::Point<dim>, dim - 1> ends;
    /// That the body fills between the sides, pi where it is flat [rad].
    double              angle;
    std::array<Side, 2> sides;
    /// Of a cell there.
    dealii::types::material_id material;

    /// Whether the body fills so much more than half that it is no part of a curved surface of flat faces:
    /// 210 degrees and more.
    bool is_reentrant() const { return angle >= 7. / 6. * dealii::numbers::PI; }
  };

  /// Returns the corners of the coarse mesh that are re-entrant or between two boundaries, on each rank all
  /// of them; none within curved boundaries (Mesh::cylinders), and none where more than two faces meet.
  template <int dim>
  std::vector<BoundaryCorner<dim>> boundary_corners(const Mesh<dim> &mesh);
} // namespace perideal

#endif
