// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/neighbourhood/precrack.h>
#include <perideal/parameters/parameter_file.h>
#include <perideal/parameters/point_text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// How far beyond its end a crack still cuts, over its size: bonds through the tip are cut.
    constexpr double tip_tolerance = 1e-9;

    bool crosses_segment(const dealii::Point<2> &p,
                         const dealii::Point<2> &q,
                         const dealii::Point<2> &a,
                         const dealii::Point<2> &b)
    {
      const auto along = q - p;
      const auto side  = [&](const dealii::Point<2> &x) {
        return along[0] * (x - p)[1] - along[1] * (x - p)[0];
      };
      const double at_a = side(a), at_b = side(b);
      if ((at_a < 0) == (at_b < 0))
        return false;
      const auto   crossing = a + at_a / (at_a - at_b) * (b - a);
      const double position = (crossing - p) * along / along.norm_square();
      return position >= -tip_tolerance && position <= 1 + tip_tolerance;
    }

    /// Whether a point of the plane of a polygon is inside or on its edge.
    bool is_inside(const std::vector<dealii::Point<3>> &polygon,
                   const dealii::Tensor<1, 3>          &normal,
                   const double                         size,
                   const dealii::Point<3>              &x)
    {
      // Drop the coordinate along which the plane is seen best.
      unsigned int largest = 0;
      for (unsigned int d = 1; d < 3; ++d)
        if (std::abs(normal[d]) > std::abs(normal[largest]))
          largest = d;
      const unsigned int u = (largest + 1) % 3, v = (largest + 2) % 3;
      bool               inside = false;
      for (std::size_t k = 0; k < polygon.size(); ++k)
        {
          const auto  &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
          const auto   edge     = q - p;
          const double position = std::clamp((x - p) * edge / edge.norm_square(), 0., 1.);
          if (x.distance(p + position * edge) <= tip_tolerance * size)
            return true;
          if ((p[v] > x[v]) != (q[v] > x[v]) && x[u] < p[u] + (x[v] - p[v]) / (q[v] - p[v]) * (q[u] - p[u]))
            inside = !inside;
        }
      return inside;
    }
  } // namespace

  void PrecrackParameters::declare(dealii::ParameterHandler &prm, const ParameterFile &file)
  {
    prm.enter_subsection("Precracks");
    for (const std::string &name : file.subsections("Precracks"))
      {
        cracks.emplace_back();
        cracks.back().name = name;
      }
    for (PrecrackText &crack : cracks)
      {
        prm.enter_subsection(crack.name);
        prm.add_parameter(
          "Points",
          crack.points,
          "Points separated by semicolons, their coordinates [m] by commas: in 2-D of a line, "
          "in 3-D of a plane polygon; bonds that cross it are cut");
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }

  template <int dim>
  Precrack<dim>::Precrack(const PrecrackText &text)
  {
    const std::string parameter = "Precracks/" + text.name + "/Points";
    for (const std::string &point : dealii::Utilities::split_string_list(text.points, ';'))
      points.push_back(read_point<dim>(point, parameter));
    if (points.size() < dim)
      throw InputError(dim == 2 ? "a crack in 2-D needs two points or more" :
                                  "a crack in 3-D needs three points or more")
        .parameter(parameter)
        .given(text.points);
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
      if (points[k].distance(points[k + 1]) == 0)
        throw InputError("a crack has the same point twice in a row").parameter(parameter).given(text.points);
    for (const auto &point : points)
      size = std::max(size, point.distance(points[0]));
    if constexpr (dim == 3)
      {
        for (std::size_t k = 1; k + 1 < points.size(); ++k)
          normal += cross_product_3d(points[k] - points[0], points[k + 1] - points[0]);
        const double area = normal.norm();
        if (area > 0)
          normal /= area;
        const bool plane = std::all_of(points.begin(), points.end(), [&](const auto &point) {
          return std::abs((point - points[0]) * normal) <= 1e-6 * size;
        });
        if (!(area > 1e-12 * size * size) || !plane)
          throw InputError("the points of a crack in 3-D must make a plane polygon")
            .parameter(parameter)
            .given(text.points);
      }
  }

  template <int dim>
  bool Precrack<dim>::crosses(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const
  {
    if constexpr (dim == 2)
      {
        for (std::size_t k = 0; k + 1 < points.size(); ++k)
          if (crosses_segment(points[k], points[k + 1], a, b))
            return true;
        return false;
      }
    else
      {
        const double at_a = (a - points[0]) * normal, at_b = (b - points[0]) * normal;
        return (at_a < 0) != (at_b < 0) &&
               is_inside(points, normal, size, a + at_a / (at_a - at_b) * (b - a));
      }
  }

  template class Precrack<2>;
  template class Precrack<3>;
} // namespace perideal
