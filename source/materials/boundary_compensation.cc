// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/boundary_compensation.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  double plane_compensation(const double horizon, const double depth)
  {
    const double h = std::min(1., std::max(0., depth / horizon));
    if constexpr (dim == 3)
      return 6. / (3. + 4. * h - h * h * h * h);
    // The cap: 2 int_h^1 r^2 acos(h/r) dr, by parts.
    const double root = std::sqrt(1. - h * h), logarithm = h > 0 ? h * h * std::acosh(1. / h) : 0.;
    const double cap = 2. / 3. * std::acos(h) - h / 3. * (root + logarithm);
    return 1. / (1. - cap / (2. * dealii::numbers::PI / 3.));
  }

  template <int dim>
  double plane_compensation(const double horizon, const std::vector<double> &depths)
  {
    double result = 1;
    for (const double depth : depths)
      result *= plane_compensation<dim>(horizon, depth);
    return result;
  }

  template double plane_compensation<2>(const double, const double);
  template double plane_compensation<3>(const double, const double);
  template double plane_compensation<2>(const double, const std::vector<double> &);
  template double plane_compensation<3>(const double, const std::vector<double> &);
} // namespace perideal
