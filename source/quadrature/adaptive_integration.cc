// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/geometry/cell_in_ball.h>
#include <perideal/quadrature/adaptive_integration.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace perideal
{
  namespace
  {
    /// Numbers of Gauss points by level.
    constexpr std::array<unsigned int, 11> outer_orders = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48};
    constexpr std::array<unsigned int, 8>  inner_orders = {1, 2, 3, 4, 6, 8, 12, 16};

    const dealii::Quadrature<1> &gauss_rule(const unsigned int n)
    {
      static const auto rules = [] {
        std::vector<dealii::QGauss<1>> result;
        for (unsigned int k = 0; k <= outer_orders.back(); ++k)
          result.emplace_back(k);
        return result;
      }();
      return rules[n];
    }

    /**
     * Gauss points of an interval: visit(place, weight). They are those of an angle, place = middle + half
     * sin(angle), so that square roots of the distances to @p roots become smooth.
     * @param roots around the interval; infinite: none
     */
    template <typename Visit>
    void
    visit_gauss(const Interval &interval, const Interval &roots, const unsigned int n, const Visit &visit)
    {
      const auto  &rule   = gauss_rule(n);
      const double length = interval.end - interval.begin;
      if (std::isinf(roots.begin) && std::isinf(roots.end))
        {
          for (unsigned int q = 0; q < n; ++q)
            visit(interval.begin + length * rule.point(q)[0], length * rule.weight(q));
          return;
        }
      // What is farther than this is smooth anyhow.
      constexpr double far    = 10.;
      const double     lower  = std::max(roots.begin, interval.begin - far * length);
      const double     upper  = std::min(roots.end, interval.end + far * length);
      const double     middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
      const auto angle = [&](const double x) { return std::asin(std::clamp((x - middle) / half, -1., 1.)); };
      const double begin = angle(interval.begin), range = angle(interval.end) - begin;
      for (unsigned int q = 0; q < n; ++q)
        {
          const double at = begin + range * rule.point(q)[0];
          visit(middle + half * std::sin(at), range * rule.weight(q) * half * std::cos(at));
        }
    }

    constexpr double   infinity = std::numeric_limits<double>::infinity();
    constexpr Interval no_roots = {-infinity, infinity};

    /// The nearest roots on either side of an interval.
    Interval roots_around(const Interval &interval, const std::vector<double> &roots)
    {
      const double unit   = 1e-12 * (interval.end - interval.begin);
      Interval     result = no_roots;
      for (const double root : roots)
        if (root <= interval.begin + unit)
          result.begin = std::max(result.begin, std::min(root, interval.begin));
        else if (root >= interval.end - unit)
          result.end = std::min(result.end, std::max(root, interval.end));
      return result;
    }

    /// Ends of 2^level intervals: visit(place, weight).
    template <typename Visit>
    void visit_trapezoid(const Interval &interval, const unsigned int level, const Visit &visit)
    {
      // A hair inside, where sections are what they are next to the end.
      constexpr double   hair = 1e-13;
      const unsigned int n    = 1u << level;
      const double       step = (interval.end - interval.begin) / n;
      for (unsigned int k = 0; k <= n; ++k)
        {
          const double share = std::clamp(static_cast<double>(k) / n, hair, 1. - hair);
          visit(interval.begin + share * (interval.end - interval.begin),
                (k == 0 || k == n ? 0.5 : 1.) * step);
        }
    }

    /// Points of a polygon with a disk: visit(y, z, weight).
    template <typename Visit>
    void visit_section(const DiskedPolygon  &section,
                       const IntegrationRule rule,
                       const unsigned int    level,
                       const unsigned int    inner_level,
                       const Visit          &visit)
    {
      std::vector<double>   kinks;
      std::vector<Interval> chords;
      section.find_kinks(kinks);
      // visit_chord(chord, visit_point) has the points of a chord.
      const auto along_chords = [&](const auto &visit_chord) {
        return [&](const double y, const double weight) {
          section.find_chords(y, chords);
          for (const Interval &chord : chords)
            visit_chord(chord, [&](const double z, const double w) { visit(y, z, weight * w); });
        };
      };
      const auto gauss_chord = [&](const Interval &chord, const auto &visit_point) {
        visit_gauss(chord, no_roots, inner_orders[inner_level], visit_point);
      };
      const auto trapezoid_chord = [&](const Interval &chord, const auto &visit_point) {
        visit_trapezoid(chord, level, visit_point);
      };
      const double   radius = std::sqrt(std::max(0., section.radius_square));
      const Interval disk   = {-radius, radius};
      for (std::size_t k = 0; k + 1 < kinks.size(); ++k)
        {
          const Interval part = {kinks[k], kinks[k + 1]};
          if (rule == IntegrationRule::trapezoid)
            visit_trapezoid(part, level, along_chords(trapezoid_chord));
          else
            visit_gauss(part,
                        section.ends_at_disk(0.5 * (part.begin + part.end)) ? disk : no_roots,
                        outer_orders[level],
                        along_chords(gauss_chord));
        }
    }

    /// Points of a cell with a ball: visit(coordinates, weight).
    template <typename Visit>
    void visit_cell(const CellSections<2> &sections,
                    const IntegrationRule  rule,
                    const unsigned int     level,
                    const unsigned int     inner_level,
                    const Visit           &visit)
    {
      visit_section(
        sections.section(),
        rule,
        level,
        inner_level,
        [&](const double y, const double z, const double weight) { visit(dealii::Point<2>(y, z), weight); });
    }

    template <typename Visit>
    void visit_cell(const CellSections<3> &sections,
                    const IntegrationRule  rule,
                    const unsigned int     level,
                    const unsigned int     inner_level,
                    const Visit           &visit)
    {
      const auto at = [&](const double x, const double weight) {
        visit_section(
          sections.section(x), rule, level, inner_level, [&](const double y, const double z, const double w) {
            visit(dealii::Point<3>(x, y, z), weight * w);
          });
      };
      const std::vector<double> &kinks = sections.kinks();
      for (std::size_t k = 0; k + 1 < kinks.size(); ++k)
        {
          const Interval part = {kinks[k], kinks[k + 1]};
          if (rule == IntegrationRule::trapezoid)
            visit_trapezoid(part, level, at);
          else
            visit_gauss(part, roots_around(part, sections.roots()), outer_orders[level], at);
        }
    }

    /// The axes, that along which the cell lies from the centre last: there the limits slope least.
    template <int dim>
    std::array<int, dim>
    order_axes(const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const IntegrationRule rule)
    {
      std::array<int, dim> result;
      std::iota(result.begin(), result.end(), 0);
      dealii::Tensor<1, dim> offset;
      for (const auto &vertex : cell)
        offset += vertex - centre;
      if (rule == IntegrationRule::gauss)
        std::stable_sort(result.begin(), result.end(), [&](const int a, const int b) {
          return std::abs(offset[a]) < std::abs(offset[b]);
        });
      return result;
    }

    template <int dim>
    CellVertices<dim> along_axes(const CellVertices<dim>    &cell,
                                 const dealii::Point<dim>   &centre,
                                 const std::array<int, dim> &axis)
    {
      CellVertices<dim> result;
      for (unsigned int v = 0; v < cell.size(); ++v)
        for (int d = 0; d < dim; ++d)
          result[v][d] = cell[v][axis[d]] - centre[axis[d]];
      return result;
    }
  } // namespace

  template <int dim>
  CellPoints<dim>::CellPoints(const CellVertices<dim>  &cell,
                              const dealii::Point<dim> &centre,
                              const double              radius,
                              const IntegrationRule     rule)
    : cell(cell)
    , centre(centre)
    , rule(rule)
    , is_inside(place_of<dim>(cell, centre, radius) == PlaceOfCell::inside)
    , axis(order_axes<dim>(cell, centre, rule))
    , sections(along_axes<dim>(cell, centre, axis),
               is_inside ? std::numeric_limits<double>::infinity() : radius)
  {
  }

  template <int dim>
  unsigned int CellPoints<dim>::n_inner_levels() const
  {
    return rule == IntegrationRule::gauss && !is_inside ? inner_orders.size() : 1;
  }

  template <int dim>
  bool CellPoints<dim>::make(const unsigned int level, const unsigned int inner_level)
  {
    if (rule == IntegrationRule::gauss ? level >= outer_orders.size() :
                                         std::pow((1u << level) + 1., dim) > most_points)
      return false;
    point.clear();
    weight.clear();
    if (rule == IntegrationRule::gauss && is_inside)
      make_inside(outer_orders[level]);
    else
      visit_cell(sections, rule, level, inner_level, [&](const dealii::Point<dim> &place, const double w) {
        dealii::Point<dim> x;
        for (int d = 0; d < dim; ++d)
          x[axis[d]] = centre[axis[d]] + place[d];
        point.push_back(x);
        weight.push_back(w);
      });
    return true;
  }

  template <int dim>
  void CellPoints<dim>::make_inside(const unsigned int n)
  {
    using Geometry = dealii::GeometryInfo<dim>;
    const dealii::Quadrature<dim> quadrature(gauss_rule(n));
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        dealii::Point<dim>     x;
        dealii::Tensor<2, dim> jacobian;
        for (unsigned int v = 0; v < cell.size(); ++v)
          {
            x += Geometry::d_linear_shape_function(quadrature.point(q), v) * cell[v];
            jacobian += outer_product(dealii::Tensor<1, dim>(cell[v]),
                                      Geometry::d_linear_shape_function_gradient(quadrature.point(q), v));
          }
        point.push_back(x);
        weight.push_back(quadrature.weight(q) * determinant(jacobian));
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(CellPoints)
} // namespace perideal
