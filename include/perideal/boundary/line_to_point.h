// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_line_to_point_h
#define perideal_boundary_line_to_point_h

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
   * the published one, (4.25)-(4.45), is of finite stretch, and takes xi_2 = 2 h where it is s + h (4.20), so
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
    Density as_published(const double sigma, const double s, const double distance) const;
  };
} // namespace perideal

#endif
