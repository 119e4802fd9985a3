// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_singular_exponents_h
#define perideal_fracture_singular_exponents_h

namespace perideal
{
  /// Returns p of the strains r^-p at a distance r from a corner with free sides, 1/2 at the tip of a crack,
  /// 0 where nothing is singular: of q = 1 - p, the smaller root of sin(q angle) + q sin(angle) = 0
  /// (symmetric motions; Williams, Journal of Applied Mechanics 19, 526-528, 1952).
  /// @param angle that the body fills, 0 to 2 pi [rad]
  double exponent_of_free_corner(const double angle);

  /// Returns the same of a corner between a clamped side and a free one: of q = 1 - p, the smallest root of
  /// sin^2(q angle) = ((kappa + 1)^2 - 4 q^2 sin^2(angle))/(4 kappa) (there). Where roots are
  /// complex, and of re-entrant corners, 1/2: the real part of a flat one, p of blunt ones is less.
  /// @param kappa 3 - 4 nu in plane strain, (3 - nu)/(1 + nu) in plane stress [-]
  double exponent_of_clamped_corner(const double angle, const double kappa);
} // namespace perideal

#endif
