// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_crack_branching_h
#define perideal_fracture_crack_branching_h

#include <array>
#include <optional>
#include <vector>

namespace perideal
{
  /// Describes where a crack branches.
  struct Branching
  {
    /// Distance from the origin along the crack's direction [m].
    double reach;
    /// Angle between the outermost branches [degrees].
    double full_angle;
    /// The largest number of bands that twelve columns in a row hold at least.
    unsigned int n_branches;
  };

  /**
   * Finds where a crack begins to run on in two bands or more. Nodes are put into columns one spacing wide
   * along the crack's direction; a band is what a column holds without a gap of 3.5 spacings. The crack
   * branches at the first column beyond the origin that has two bands and is followed by eleven such. The
   * angle is that between the lines of least squares through the middles of the outermost bands over a length
   * behind.
   *
   * @param nodes of the crack: coordinates from its origin, along its direction and across [m]
   * @param spacing of the nodes [m]
   * @param length along the direction over which the angle is measured [m]
   */
  std::optional<Branching>
  find_branching(const std::vector<std::array<double, 2>> &nodes, const double spacing, const double length);
} // namespace perideal

#endif
