// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_geometry_body_rays_h
#define perideal_geometry_body_rays_h

#include <deal.II/base/point.h>

#include <array>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Finds the parts of a straight line that lie inside a body, from the faces of its boundary within reach.
   * Faces of hexahedra are taken as two triangles.
   */
  template <int dim>
  class BodyRays
  {
  public:
    /// Part of a line, by distance from its start [m].
    using Part = std::pair<double, double>;

    /// @param vertices of a face, in deal.II's order [m]
    /// @param outward its outward normal
    void add_face(const std::vector<dealii::Point<dim>> &vertices, const dealii::Tensor<1, dim> &outward);

    /// Whether there is no boundary within reach: all lines are inside.
    bool empty() const { return pieces.empty(); }

    /// The parts inside the body, from the start on, of a line that starts in the body or on its boundary.
    /// @param direction unit vector
    std::vector<Part> parts_inside(const dealii::Point<dim>     &start,
                                   const dealii::Tensor<1, dim> &direction,
                                   const double                  length) const;

  private:
    /// A segment in 2-D, a triangle in 3-D.
    struct Piece
    {
      std::array<dealii::Point<dim>, dim> corners;
      /// Unit normal out of the body.
      dealii::Tensor<1, dim> outward;
    };

    /// Whether a point of the piece's line or plane is in the piece or on its edge.
    static bool contains(const Piece &piece, const dealii::Point<dim> &point);

    void add_piece(const std::array<dealii::Point<dim>, dim> &corners, const dealii::Tensor<1, dim> &outward);

    std::vector<Piece> pieces;
  };
} // namespace perideal

#endif
