// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_face_tractions_h
#define perideal_boundary_face_tractions_h

#include <perideal/boundary/boundary_faces.h>
#include <perideal/boundary/surface_planes.h>

#include <vector>

namespace perideal
{
  /// The resultant of forces [N] and their moment about a point [N m]; in 2-D moments are about z.
  template <int dim>
  struct Resultant
  {
    dealii::Tensor<1, dim> force;
    dealii::Tensor<1, 3>   moment;

    /// Adds a force.
    /// @param arm from the point of the moment to where it acts [m]
    void add(const dealii::Tensor<1, dim> &arm, const dealii::Tensor<1, dim> &acting);
  };

  /// A vector with a third component of zero in 2-D.
  template <int dim>
  dealii::Tensor<1, 3> in_space(const dealii::Tensor<1, dim> &vector);

  /// A quadrature point of a face.
  template <int dim>
  struct FacePoint
  {
    dealii::Point<dim>     position;
    dealii::Tensor<1, dim> normal;
    /// The part of the face that it stands for [m^2].
    double area;
  };

  /// Two Gauss points in each direction on the (bi)linear face through its corners.
  /// @tparam Face BoundaryFace or SurfaceFace
  template <int dim, typename Face>
  std::vector<FacePoint<dim>> quadrature_points(const Face &face);

  /**
   * The traction of a condition integrated over a face, by two Gauss points in each direction: exact for
   * force and moment of linear tractions on flat faces.
   * @tparam Face BoundaryFace or SurfaceFace
   * @param about point that the moment is taken about
   */
  template <int dim, typename Face>
  Resultant<dim> integrate_traction(const BoundaryCondition<dim> &condition,
                                    const Face                   &face,
                                    const double                  time,
                                    const dealii::Point<dim>     &about);
} // namespace perideal

#endif
