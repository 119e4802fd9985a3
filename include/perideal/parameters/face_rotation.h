// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_face_rotation_h
#define perideal_parameters_face_rotation_h

#include <perideal/parameters/tables.h>

#include <array>
#include <string>

namespace perideal
{
  /// A prescribed rotation of a boundary, as text.
  struct RotationText
  {
    /// Angle [rad], a formula; empty: none.
    std::string angle;
    /// A point of the axis [m], and in 3-D the direction along it, coordinates separated by commas.
    std::string point, direction;

    bool is_given() const { return !(angle.empty() && point.empty() && direction.empty()); }
  };

  /**
   * The displacement of a rotation by the angle a about an axis through p along the unit vector k, by
   * component, as formulas: with r = x - p (Rodrigues)
   *
   *     u = sin(a) k x r + (1 - cos(a)) k x (k x r),
   *
   * or what is linear in the angle, u = a k x r, which keeps lengths where strains are linear.
   * @param section path of the condition with a '/' behind it
   * @throws InputError on a wrong angle, point or direction, and where one is missing.
   */
  template <int dim>
  std::array<std::string, 3> displacement_of_rotation(const RotationText &rotation,
                                                      const bool          is_small,
                                                      const std::string  &section,
                                                      const Tables       &tables);
} // namespace perideal

#endif
