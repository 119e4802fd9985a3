// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_scattered_field_h
#define perideal_parameters_scattered_field_h

#include <deal.II/base/point.h>

#include <memory>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * A function of place through values at any points, such as the nodes of another mesh: the constant of a
   * linear fit by weighted least squares to the points around, which takes the given values at the points and
   * is exact for linear functions. It does not change along axes of which the points have no coordinate.
   */
  class ScatteredField
  {
  public:
    /// @param points [m], one or more @param values as many
    /// @param axes whose coordinates count, one to three of 0, 1, 2
    /// @param holds whether the field is that of the nearest point beyond the points
    ScatteredField(std::vector<dealii::Point<3>> points,
                   std::vector<double>           values,
                   std::vector<unsigned int>     axes,
                   const bool                    holds);

    /// The value at a point [m], its z zero in 2-D; not a number where covers() is false.
    double value(const dealii::Point<3> &point) const;

    /// Whether a point [m] is as near to one of the field's points as that one is to those around it.
    bool covers(const dealii::Point<3> &point) const;

    /// "x from 0 to 1.2 m, y from 0 to 0.5 m".
    std::string range() const;

  private:
    struct Tree;

    /// Points around a place, the nearest one first, and how far the others are from it.
    struct Surroundings
    {
      std::vector<std::size_t> points;
      double                   to_nearest, spread;
    };

    dealii::Point<3> on_axes(const dealii::Point<3> &point) const;
    Surroundings     around(const dealii::Point<3> &place) const;

    std::vector<dealii::Point<3>> points;
    std::vector<double>           values;
    std::vector<unsigned int>     axes;
    bool                          holds;
    std::shared_ptr<const Tree>   tree;
  };
} // namespace perideal

#endif
