// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_bonds_through_plane_h
#define perideal_quadrature_bonds_through_plane_h

#include <perideal/geometry/body_rays.h>

#include <deal.II/base/point.h>

#include <vector>

namespace perideal
{
  /// Samples the bonds of the continuous body, with which
  ///
  ///     sum weight f(xi) = int_0^d ds int_{(x' - x).n >= 0, |xi| <= d} f dV',    xi = x' - near, near = x -
  ///     s n:
  ///
  /// the areal force density at x on the plane normal to n (Silling 2000; QUAD (2.12)).
  template <int dim>
  struct BondsThroughPlane
  {
    /// The bonds with one point of the line.
    struct Fan
    {
      dealii::Point<dim>                  near;
      std::vector<dealii::Tensor<1, dim>> bond;
      /// In 2-D of unit thickness [m^(dim+1)].
      std::vector<double> weight;
    };

    /// Numbers of points. In the coordinates s, |xi| and the direction of xi the kernels of bonds are smooth,
    /// and with the direction outermost the domain is a triangle, s < |xi| cos < d cos, so that sums are
    /// exact for polynomials.
    struct Orders
    {
      /// Gauss points in the cosine between bond and normal (3-D) or in their angle (2-D), and points of the
      /// trapezoidal rule about the normal (3-D).
      unsigned int polar, azimuth;
      /// Gauss points along the line, and along each direction.
      unsigned int line, radial;

      /// For bonds that no boundary cuts. Bonds of a uniform strain eps have forces of which the part of
      /// order eps^k is a polynomial of degree 2k+1 of the direction, and times the cosine of the line's
      /// length of degree 2k+2: six and twelve points are exact up to k = 4, so that the error is of order
      /// eps^4 of the stress. Second gradients add one power of s or |xi|, for which two radial points (to
      /// degree 3) and three of the line (to degree 5) serve; the third radial one is for displacements that
      /// are not quadratic.
      static constexpr Orders smooth() { return {dim == 3 ? 6 : 10, 12, 3, 3}; }
      /// Where the boundary cuts bonds, which has kinks: errors of about 1e-3.
      static constexpr Orders cut() { return {12, 24, 6, 2}; }
    };

    /// The bonds at @p x with the unit normal @p n, those that reach out of the body left out.
    /// @param body has the boundary within the horizon of x
    static std::vector<Fan> find(const dealii::Point<dim>     &x,
                                 const dealii::Tensor<1, dim> &n,
                                 const double                  horizon,
                                 const BodyRays<dim>          &body,
                                 const Orders                 &orders);
  };
} // namespace perideal

#endif
