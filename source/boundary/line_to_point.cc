// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/line_to_point.h>

#include <cmath>

namespace perideal
{
  LineToPoint::Density
  LineToPoint::closed_form(const double sigma, const double s, const double distance) const
  {
    const double near = std::hypot(distance, s), far = horizon;
    if (near >= far)
      return {};
    // int z^3/r^3 = r + D^2/r, int z/r^3 = -1/r, int z^2/r^3 = asinh(z/D) - z/r, int D^2/r^3 = z/r.
    const double along = sigma / young_modulus, across = -poisson_ratio * along;
    const double square = distance * distance;
    Density      result;
    result.along_normal =
      micromodulus * (along * (far - near) + (along - across) * square * (1. / far - 1. / near));
    if (distance > 1e-12 * horizon)
      {
        const double top   = std::sqrt(far * far - square);
        const double ratio = top / far - s / near;
        result.across =
          micromodulus * distance *
          (along * (std::asinh(top / distance) - std::asinh(s / distance) - ratio) + across * ratio);
      }
    return result;
  }

  LineToPoint::Density
  LineToPoint::as_published(const double sigma, const double s, const double distance) const
  {
    const double strain = sigma / young_modulus;
    if (std::hypot(distance, s) > horizon || strain == 0)
      return {};
    // (4.36) with (4.37), and (4.42) with (4.43).
    const double d2 = distance * distance, delta2 = horizon * horizon;
    const auto   template_1 = [&](const double a, const double b) {
      const double t = std::sqrt(b * b * (delta2 - d2) / (d2 * (a * a - b * b) + b * b * delta2));
      return (std::log1p(t) - std::log1p(-t)) / (4. * b);
    };
    const auto template_2 = [&](const double a, const double b) {
      return (std::sqrt(d2 * (a * a - b * b) + b * b * delta2) - a * distance) / (4. * b * b);
    };
    const double a = 1. - poisson_ratio * strain, b = 1. + strain;
    Density      result;
    result.along_normal = 2. * micromodulus * b * (template_2(1., 1.) - template_2(a, b));
    if (distance > 1e-12 * horizon)
      result.across = micromodulus * a * distance * (template_1(1., 1.) - template_1(a, b));
    return result;
  }
} // namespace perideal
