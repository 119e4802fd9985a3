// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/least_squares.h>
#include <perideal/parameters/scattered_field.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace perideal
{
  struct ScatteredField::Tree
  {
    explicit Tree(const std::vector<dealii::Point<3>> &points)
      : indices(dealii::pack_rtree_of_indices(points))
    {
    }

    decltype(dealii::pack_rtree_of_indices(std::declval<const std::vector<dealii::Point<3>> &>())) indices;
  };

  ScatteredField::ScatteredField(std::vector<dealii::Point<3>> points,
                                 std::vector<double>           values,
                                 std::vector<unsigned int>     axes,
                                 const bool                    holds)
    : points(std::move(points))
    , values(std::move(values))
    , axes(std::move(axes))
    , holds(holds)
  {
    AssertDimension(this->points.size(), this->values.size());
    for (dealii::Point<3> &point : this->points)
      point = on_axes(point);
    tree = std::make_shared<const Tree>(this->points);
  }

  dealii::Point<3> ScatteredField::on_axes(const dealii::Point<3> &point) const
  {
    dealii::Point<3> result;
    for (const unsigned int axis : axes)
      result[axis] = point[axis];
    return result;
  }

  ScatteredField::Surroundings ScatteredField::around(const dealii::Point<3> &place) const
  {
    // Twice the corners of a cell of a grid.
    const unsigned int n_wanted = 2u << axes.size();
    Surroundings       result;
    tree->indices.query(boost::geometry::index::nearest(place, n_wanted), std::back_inserter(result.points));
    std::sort(result.points.begin(), result.points.end(), [&](const std::size_t a, const std::size_t b) {
      const double of_a = place.distance_square(points[a]), of_b = place.distance_square(points[b]);
      return of_a != of_b ? of_a < of_b : a < b;
    });
    const dealii::Point<3> &nearest = points[result.points.front()];
    result.to_nearest               = place.distance(nearest);
    result.spread                   = 0;
    for (const std::size_t k : result.points)
      result.spread = std::max(result.spread, nearest.distance(points[k]));
    return result;
  }

  double ScatteredField::value(const dealii::Point<3> &point) const
  {
    const dealii::Point<3> place = on_axes(point);
    const Surroundings     near  = around(place);
    if (near.to_nearest > near.spread)
      return holds ? values[near.points.front()] : std::numeric_limits<double>::quiet_NaN();
    if (near.to_nearest <= 1e-12 * near.spread)
      return values[near.points.front()];

    // A row for each point: its value is the field's at the place and a slope times its distance, scaled.
    // Points close by decide alone, so that the fit goes through them.
    Eigen::MatrixXd rows(near.points.size(), axes.size() + 1);
    Eigen::VectorXd right(near.points.size());
    for (std::size_t k = 0; k < near.points.size(); ++k)
      {
        const auto   step   = points[near.points[k]] - place;
        const double weight = near.to_nearest / step.norm();
        rows(k, 0)          = weight;
        for (std::size_t a = 0; a < axes.size(); ++a)
          rows(k, a + 1) = weight * step[axes[a]] / near.spread;
        right[k] = weight * values[near.points[k]];
      }
    return least_squares(rows, right)[0];
  }

  bool ScatteredField::covers(const dealii::Point<3> &point) const
  {
    const Surroundings near = around(on_axes(point));
    return holds || near.to_nearest <= near.spread;
  }

  std::string ScatteredField::range() const
  {
    std::ostringstream text;
    for (const unsigned int axis : axes)
      {
        const auto before = [axis](const dealii::Point<3> &a, const dealii::Point<3> &b) {
          return a[axis] < b[axis];
        };
        const auto ends = std::minmax_element(points.begin(), points.end(), before);
        text << (axis == axes.front() ? "" : ", ") << "xyz"[axis] << " from " << (*ends.first)[axis] << " to "
             << (*ends.second)[axis] << " m";
      }
    return text.str();
  }
} // namespace perideal
