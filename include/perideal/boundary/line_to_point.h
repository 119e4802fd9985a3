// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_line_to_point_h
#define perideal_boundary_line_to_point_h

#include <perideal/boundary/surface_planes.h>

#include <vector>

namespace perideal
{
  /**
   * The line-to-point force density of bond-based peridynamics (QUAD 4.1): what the material on the normal of
   * a surface point x_s, outside a body under uniaxial stress along the normal n, does to a point below the
   * surface,
   *
   *     f_L = int c (1/|xi| - 1/|xi + eta|)(xi + eta) dz,   xi = D e + z n,  s <= z <= sqrt(d^2 - D^2),
   *
   * with the depth s of the point, the distance D of x_s from the point's foot along e, and the strains eps
   * along n, -nu eps across. The closed form here is that of the linear force,
   *
   *     f_L.n = c (eps (d - r) + (1 + nu) eps D^2 (1/d - 1/r)),   r = sqrt(D^2 + s^2);
   *
   * the printed one, (4.25)-(4.45), is of finite stretch, and takes xi_2 = 2 h where it is s + h (4.20), so
   * that the depth is lost: it recovers a third less.
   */
  struct LineToPoint
  {
    /// c [N/m^6], horizon [m], E [Pa], nu.
    double micromodulus, horizon, young_modulus, poisson_ratio;

    /// Components of f_L along n and along e [N/m^5], for a traction sigma along n [Pa].
    struct Density
    {
      double along_normal = 0, across = 0;
    };
    Density closed_form(const double sigma, const double s, const double distance) const;
    Density as_printed(const double sigma, const double s, const double distance) const;
  };

  /**
   * Adds to nodes within their horizons of loaded faces what line-to-point force densities make of the
   * tractions [N]: V_i sum over faces of int f_L dS (4.48), the closed form with 3 x 3 Gauss points a face,
   * the printed one with one as on a grid of nodes.
   * @param law_of a node
   * @throws InputError on all ranks where a traction is not along the normal (4.47).
   */
  void add_line_to_point_forces(const NodeCloud<3>                                 &nodes,
                                const std::vector<SurfaceFace<3>>                  &faces,
                                const Loads<3>                                     &loads,
                                const double                                        time,
                                const std::function<LineToPoint(const LocalIndex)> &law_of,
                                const bool                                          as_printed,
                                NodalVector                                        &force);
} // namespace perideal

#endif
