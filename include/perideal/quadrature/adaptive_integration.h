// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_adaptive_integration_h
#define perideal_quadrature_adaptive_integration_h

#include <perideal/geometry/cell_sections.h>
#include <perideal/nodes/nodes.h>
#include <perideal/quadrature/quadrature_parameters.h>

#include <deal.II/base/point.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace perideal
{
  /// Integration ends when a value changes by at most relative times itself, or, where the value is not above
  /// absolute, by at most relative (the thesis' EPS and TOL; section 2.4.3).
  struct IntegrationTolerance
  {
    double relative = 1e-6, absolute = 1e-4;

    bool is_met(const double change, const double value) const
    {
      return change <= (value > absolute ? relative * value : relative);
    }
  };

  template <typename Value>
  struct IntegrationResult
  {
    Value value;
    /// Points of the last value, and of all values on the way to it.
    std::size_t n_points = 0, n_evaluations = 0;
    /// False when there would have been more than CellPoints::most_points.
    bool converged = false;
  };

  /// Points and weights over the part of a cell that lies within a ball.
  template <int dim>
  class CellPoints
  {
  public:
    CellPoints(const CellVertices<dim>  &cell,
               const dealii::Point<dim> &centre,
               const double              radius,
               const IntegrationRule     rule);

    static constexpr std::size_t most_points = 1u << 20;

    /**
     * Finer and finer points. Levels from 0; of Gauss points there is a second level for the innermost
     * direction, along which limits are exact and have no kinks.
     * @return false where there would be too many points
     */
    bool make(const unsigned int level, const unsigned int inner_level);

    /// Whether all of the cell lies within the ball.
    bool whole_cell() const { return is_inside; }

    /// Levels of the innermost direction; 1 where it has none of its own.
    unsigned int n_inner_levels() const;

    std::vector<dealii::Point<dim>> point;
    std::vector<double>             weight;

  private:
    /// Gauss points of the whole cell, @p n along each direction.
    void make_inside(const unsigned int n);

    CellVertices<dim>  cell;
    dealii::Point<dim> centre;
    IntegrationRule    rule;
    bool               is_inside;
    /// Which axis the directions of integration have, the innermost one last.
    std::array<int, dim> axis;
    CellSections<dim>    sections;
  };

  namespace internal
  {
    inline double magnitude(const double value)
    {
      return std::abs(value);
    }
    template <int rank, int dim>
    double magnitude(const dealii::Tensor<rank, dim> &value)
    {
      return value.norm();
    }

    template <int dim, typename Value, typename Function>
    Value sum_over(const Function &f, const CellPoints<dim> &points, IntegrationResult<Value> &result)
    {
      Value sum{};
      for (std::size_t q = 0; q < points.point.size(); ++q)
        sum += points.weight[q] * f(points.point[q]);
      result.n_points = points.point.size();
      result.n_evaluations += points.point.size();
      return sum;
    }
  } // namespace internal

  /**
   * The integral of @p f over the part of a cell that lies within a ball, with error control.
   *
   * Directions are nested, with exact limits. The gauss rule puts Gauss points between the kinks of these
   * limits, mapped where they end like square roots, along the innermost direction as few as the function
   * needs, and raises their number in the others until the tolerance is met. The trapezoid rule halves all
   * intervals at once, whatever the kinks.
   *
   * @param f of a point; its values are double or dealii::Tensor
   * @param tolerance above 0, by the caller's care
   */
  template <int dim, typename Function>
  auto integrate_cell_in_ball(const Function             &f,
                              const CellVertices<dim>    &cell,
                              const dealii::Point<dim>   &centre,
                              const double                radius,
                              const IntegrationRule       rule,
                              const IntegrationTolerance &tolerance)
  {
    using internal::magnitude;
    using Value = std::decay_t<decltype(f(centre))>;
    Assert(tolerance.relative > 0 && tolerance.absolute > 0, dealii::ExcInternalError());
    IntegrationResult<Value> result{};
    CellPoints<dim>          points(cell, centre, radius, rule);

    // How many points the function itself needs shows along the innermost direction.
    unsigned int inner = 0;
    if (points.n_inner_levels() > 1)
      {
        constexpr unsigned int coarse = 1;
        Value                  last{};
        for (unsigned int level = 0; level < points.n_inner_levels(); ++level)
          {
            points.make(coarse, level);
            const Value  next   = internal::sum_over<dim, Value>(f, points, result);
            const double change = magnitude(next - last), before = magnitude(last);
            // Chords elsewhere may be longer: the finer points, unless the function is as good as constant.
            if (!(level > 0 && tolerance.is_met(100. * change, before)))
              inner = level;
            if (level > 0 && tolerance.is_met(change, before))
              break;
            last = next;
          }
      }
    Value last{}, before_last{};
    for (unsigned int level = 0; !result.converged && points.make(level, inner); ++level)
      {
        result.value = internal::sum_over<dim, Value>(f, points, result);
        // Few Gauss points may agree by chance: the first two must do so better, later ones are held against
        // those before the last, too.
        const double strictness =
          rule == IntegrationRule::gauss && level == 1 && !points.whole_cell() ? 10. : 1.;
        result.converged =
          level > 0 && tolerance.is_met(strictness * magnitude(result.value - last), magnitude(last)) &&
          (rule == IntegrationRule::trapezoid || level == 1 ||
           tolerance.is_met(0.1 * magnitude(result.value - before_last), magnitude(before_last)));
        before_last = last;
        last        = result.value;
      }
    return result;
  }
} // namespace perideal

#endif
