// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/softening.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    using Curve = std::vector<std::pair<double, double>>;

    /// exp(-x) up to where a hundredth of the force is left, in lines that end at zero, of the area 1.
    Curve exponential()
    {
      constexpr unsigned int n_lines = 24;
      const double           last    = std::log(100.);
      Curve                  result;
      for (unsigned int k = 0; k <= n_lines; ++k)
        {
          const double x = last * k / n_lines;
          result.emplace_back(x, (std::exp(-x) - 0.01) / 0.99);
        }
      result.back().second = 0.;
      double area          = 0;
      for (std::size_t k = 1; k < result.size(); ++k)
        area += 0.5 * (result[k].first - result[k - 1].first) * (result[k].second + result[k - 1].second);
      for (auto &point : result)
        point.first /= area;
      return result;
    }
  } // namespace

  /// The list of laws: a new one is one line here.
  template <>
  const Registry<SofteningTraits> &Softening::list()
  {
    static const auto laws = list_by_name<SofteningTraits>(
      "Material/Softening",
      {{"none", "bonds break at once"},
       {"linear", "along one line", {{0., 1.}, {2., 0.}}},
       {"bilinear",
        "along two lines that meet at a third of it (Petersson), for concrete",
        {{0., 1.}, {0.8, 1. / 3.}, {3.6, 0.}}},
       {"exponential", "as exp(-opening), until a hundredth is left", exponential()}});
    return laws;
  }

  SofteningLaw::SofteningLaw(const Softening &softening, const bool waits)
    : curve(softening->curve)
    , is_told(waits)
  {
    for (std::size_t k = 1; k < curve.size(); ++k)
      least =
        std::max(least, 2. * (curve[k - 1].second - curve[k].second) / (curve[k].first - curve[k - 1].first));
  }

  SofteningLaw::Point
  SofteningLaw::look_at(const double stretch, const double first, const double brittle_square) const
  {
    // Stretches grow along the curve.
    const auto line = std::partition_point(curve.begin() + 1, curve.end(), [&](const auto &point) {
      return stretch_at(point, first, brittle_square) <= stretch;
    });
    if (line == curve.end())
      return {0., 0.};
    const double begin   = stretch_at(*(line - 1), first, brittle_square),
                 end     = stretch_at(*line, first, brittle_square);
    const double share   = std::max(0., (stretch - begin) / (end - begin));
    const double change  = (line->second - (line - 1)->second) * first;
    const double carried = ((line - 1)->second * first + share * change) / stretch;
    return {carried, (change / (end - begin) - carried) / stretch};
  }

  double
  SofteningLaw::stretch_bearing(const double borne, const double first, const double brittle_square) const
  {
    Assert(softens() && borne > 0 && borne < 1, dealii::ExcInternalError());
    const auto end = std::partition_point(
      curve.begin() + 1, curve.end(), [&](const auto &point) { return point.second > borne; });
    const auto   begin = end - 1;
    const double opening =
      begin->first + (end->first - begin->first) * (begin->second - borne) / (begin->second - end->second);
    return stretch_at({opening, borne}, first, brittle_square);
  }

  void SofteningLaw::look_along(const Growing &stretches,
                                const double   scale,
                                const double   first,
                                const double   brittle_square,
                                double        *result) const
  {
    unsigned int k = 0;
    // Whole up to s_0, and where a line of the curve has g = slope + constant/s, up to its end.
    const auto fill = [&](const double end, const double slope, const double constant) {
      const double last = end / scale, over = constant / scale;
      for (; k < stretches.n && stretches.unit[k] < last; ++k)
        result[k] = slope + over * stretches.inverse[k];
    };
    if (scale > 0)
      {
        for (const double last = first / scale; k < stretches.n && stretches.unit[k] <= last; ++k)
          result[k] = 1.;
        double begin = first;
        for (auto point = curve.begin(); point + 1 != curve.end() && k < stretches.n; ++point)
          {
            const double end   = stretch_at(*(point + 1), first, brittle_square),
                         slope = first * ((point + 1)->second - point->second) / (end - begin);
            fill(end, slope, first * point->second - slope * begin);
            begin = end;
          }
      }
    std::fill(result + k, result + stretches.n, scale > 0 ? 0. : 1.);
  }
} // namespace perideal
