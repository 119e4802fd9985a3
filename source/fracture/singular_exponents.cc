// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/singular_exponents.h>

#include <deal.II/base/numbers.h>

#include <boost/math/tools/roots.hpp>

#include <cmath>

namespace perideal
{
  namespace
  {
    using dealii::numbers::PI;

    /// The root of a function that changes its sign between two values.
    template <typename Function>
    double root_between(const Function &function, const double from, const double to)
    {
      const auto [low, high] =
        boost::math::tools::bisect(function, from, to, boost::math::tools::eps_tolerance<double>(40));
      return 0.5 * (low + high);
    }
  } // namespace

  double exponent_of_free_corner(const double angle)
  {
    constexpr double crack = 0.5, regular = 1.;
    const auto       function = [angle](const double q) { return std::sin(q * angle) + q * std::sin(angle); };
    if (angle <= PI)
      return 0.;
    // At the ends of the interval rounding decides about signs.
    if (function(crack) <= 0.)
      return 1. - crack;
    if (function(regular) >= 0.)
      return 0.;
    return 1. - root_between(function, crack, regular);
  }

  double exponent_of_clamped_corner(const double angle, const double kappa)
  {
    if (angle >= PI)
      return 0.5;
    constexpr unsigned int n_parts  = 64;
    const double           sine     = std::sin(angle);
    const auto             function = [=](const double q) {
      const double of_angle = std::sin(q * angle);
      return of_angle * of_angle - ((kappa + 1.) * (kappa + 1.) - 4. * q * q * sine * sine) / (4. * kappa);
    };
    for (unsigned int part = 0; part < n_parts; ++part)
      if (const double from = static_cast<double>(part) / n_parts,
          to                = static_cast<double>(part + 1) / n_parts;
          function(from) < 0. && function(to) >= 0.)
        return 1. - root_between(function, from, to);
    // Of sharp corners the roots are above 1.
    return angle <= 0.5 * PI ? 0. : 0.5;
  }
} // namespace perideal
