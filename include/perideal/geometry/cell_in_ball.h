// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_geometry_cell_in_ball_h
#define perideal_geometry_cell_in_ball_h

#include <perideal/base/types.h>
#include <perideal/geometry/cell_vertices.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace perideal
{
  /// A plane face of a hexahedron, counterclockwise as seen from outside.
  struct PlaneFace
  {
    std::array<dealii::Point<3>, 4> corner;
    unsigned int                    n_corners = 0;
  };

  /// The plane faces of a hexahedron: its own where they are plane, else four triangles about the mean of a
  /// face's vertices, the same from both of its sides. Their number is that of the result.
  unsigned int plane_faces(const CellVertices<3> &cell, std::array<PlaneFace, 24> &faces);

  /// Volume [m^dim] and first moment, the integral of x [m^(dim+1)].
  template <int dim>
  struct CellMoments
  {
    double                 volume = 0;
    dealii::Tensor<1, dim> moment;

    dealii::Point<dim> centroid() const { return dealii::Point<dim>(moment / volume); }
  };

  /// Area of a quadrilateral, volume of a hexahedron.
  template <int dim>
  double cell_volume(const CellVertices<dim> &cell);

  /// Computes how much of a cell lies within a ball, in closed form [m^dim].
  ///
  /// The parts of the cell's edges within the ball bound flat triangles, the parts without bound sectors of
  /// the disk that a face cuts from the ball, and solid angles seen from its centre; their signed sums need
  /// no clipped polyhedron. The relative error is that of rounding, times the cell's distance from the centre
  /// over its size. Cells need not be convex.
  template <int dim>
  double volume_in_ball(const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius);

  /// The same with the first moment, and so the centroid of what lies within.
  template <int dim>
  CellMoments<dim>
  moments_in_ball(const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius);

  /// Tells whether a cell lies inside, outside or across a ball, as far as its vertices and the box around
  /// them tell.
  enum class PlaceOfCell
  {
    inside,
    outside,
    perhaps_cut
  };
  template <int dim>
  PlaceOfCell place_of(const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius);
} // namespace perideal

#endif
