// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_boundary_compensation_h
#define perideal_materials_boundary_compensation_h

#include <vector>

namespace perideal
{
  /**
   * The boundary effect compensation factor of a node at a depth h below a plane surface: the energy of an
   * isotropic expansion in a whole family of bond-based peridynamics over that in the part within the body,
   *
   *     beta_s = int |xi| dV (whole) / int |xi| dV (part) = 6 d^4/(3 d^4 + 4 d^3 h - h^4) in 3-D,
   *
   * QUAD (4.49)-(4.51) with their signs corrected: as printed, the factor grows with the depth. In 2-D
   * the part is d^3 (2 pi/3) minus what the cap beyond the plane has.
   */
  template <int dim>
  double plane_compensation(const double horizon, const double depth);

  /// That of several planes: as if each took its share of what the others leave, which is so at square edges
  /// and corners (h = 0), and where horizons reach one plane only.
  template <int dim>
  double plane_compensation(const double horizon, const std::vector<double> &depths);
} // namespace perideal

#endif
