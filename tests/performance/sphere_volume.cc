// SPDX-License-Identifier: LGPL-2.1-or-later

// The volume of a horizon's sphere in a grid of cubes, by the schemes of section "Quadrature": K. Yu's
// thesis, section 2.5.1, Tables 2.2 and 2.3. Prints a Markdown table; see README.md beside this file.

#include <perideal/geometry/cell_in_ball.h>
#include <perideal/quadrature/adaptive_integration.h>
#include <perideal/quadrature/bond_volume.h>

#include <deal.II/base/numbers.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

namespace
{
  using namespace perideal;

  /// Volume [cells] and number of integration points.
  struct Counted
  {
    double      volume = 0;
    std::size_t points = 0;
  };

  /// Counts one cell of a horizon of @p m spacings.
  using CountCell = std::function<void(const dealii::Point<3> &middle, const int m, Counted &sum)>;

  CellVertices<3> cube(const dealii::Point<3> &middle)
  {
    CellVertices<3> result;
    for (unsigned int v = 0; v < 8; ++v)
      for (int d = 0; d < 3; ++d)
        result[v][d] = middle[d] + ((v >> d) & 1u ? 0.5 : -0.5);
    return result;
  }

  CountCell cubic_cells(const bool cuts_off)
  {
    return [cuts_off](const dealii::Point<3> &middle, const int m, Counted &sum) {
      const double share = linear_share(m, 1., middle.norm());
      if (share == 0 || (cuts_off && middle.square() > m * m))
        return;
      sum.volume += share;
      ++sum.points;
    };
  }

  /// One point a cell: the centroid of what lies within.
  void exact_cells(const dealii::Point<3> &middle, const int m, Counted &sum)
  {
    const double part = volume_in_ball<3>(cube(middle), {}, m);
    sum.volume += part;
    sum.points += part > 0;
  }

  CountCell adaptive_cells(const IntegrationRule rule, const double tolerance)
  {
    return [rule, tolerance](const dealii::Point<3> &middle, const int m, Counted &sum) {
      const auto cell  = cube(middle);
      const auto place = place_of<3>(cell, {}, m);
      if (place == PlaceOfCell::outside)
        return;
      const auto part = integrate_cell_in_ball<3>(
        [](const dealii::Point<3> &) { return 1.; }, cell, {}, m, rule, {tolerance, 1e-12});
      sum.volume += part.value;
      sum.points += part.n_points;
    };
  }

  Counted count(const CountCell &count_cell, const int m)
  {
    Counted   sum;
    const int reach = m + 1;
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        for (int i = -reach; i <= reach; ++i)
          count_cell(dealii::Point<3>(i, j, k), m, sum);
    return sum;
  }

  void print_row(const std::string &name, const CountCell &count_cell, const int m)
  {
    using Clock        = std::chrono::steady_clock;
    const auto begin   = Clock::now();
    Counted    sum     = count(count_cell, m);
    double     seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    // What is short is repeated.
    for (unsigned int repeat = 1; seconds < 0.01 && repeat < 100; ++repeat)
      {
        const auto again = Clock::now();
        sum              = count(count_cell, m);
        seconds          = std::min(seconds, std::chrono::duration<double>(Clock::now() - again).count());
      }
    const double ball = 4 * dealii::numbers::PI / 3 * m * m * m;
    // The thesis' horizon is 18 h.
    const double adip = 18. / m * std::cbrt(ball / sum.points);
    std::printf("| d/%d | %s | %.4g | %zu | %.3f | %.0f |\n",
                m,
                name.c_str(),
                100 * std::abs(sum.volume / ball - 1),
                sum.points,
                adip,
                1e6 * seconds);
  }
} // namespace

int main()
{
  std::printf("| spacing | scheme | error of the volume [%%] | points | ADIP [h] | microseconds |\n"
              "|--:|---|--:|--:|--:|--:|\n");
  for (const int m : {3, 4, 5, 6, 8, 9, 10, 15, 20, 30})
    {
      print_row("cubic cell", cubic_cells(true), m);
      print_row("partial volume", cubic_cells(false), m);
      for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-6})
        {
          char name[40];
          std::snprintf(name, sizeof(name), "adaptive, gauss, %g", tolerance);
          print_row(name, adaptive_cells(IntegrationRule::gauss, tolerance), m);
        }
      // Fine grids to 1e-2 take minutes.
      for (const double tolerance : {1e-1, 1e-2})
        if (tolerance > 0.05 || m <= 6)
          {
            char name[40];
            std::snprintf(name, sizeof(name), "adaptive, trapezoid, %g", tolerance);
            print_row(name, adaptive_cells(IntegrationRule::trapezoid, tolerance), m);
          }
      print_row("exact", exact_cells, m);
    }
}
