// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/registry.h>
#include <perideal/materials/influence_function.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace perideal
{
  namespace
  {
    // omega = 1
    double constant(const double)
    {
      return 1.;
    }

    // omega = horizon/|xi|
    double inverse(const double s)
    {
      return 1. / s;
    }

    // omega = exp(-(2 s)^2)
    double gaussian(const double s)
    {
      return std::exp(-4. * s * s);
    }

    // The cubic B-spline that vanishes at s = 1 with two derivatives.
    double cubic_spline(const double s)
    {
      if (s < 0.5)
        return 2. / 3. - 4. * s * s + 4. * s * s * s;
      return s < 1 ? 4. / 3. * (1 - s) * (1 - s) * (1 - s) : 0.;
    }

    struct Choice
    {
      double (*function)(const double);
      bool fades_out;
    };

    const Registry<Choice> &choices()
    {
      static const Registry<Choice> list("Nodes/Influence function",
                                         {{"constant", {&constant, false}},
                                          {"inverse", {&inverse, false}},
                                          {"gaussian", {&gaussian, true}},
                                          {"cubic spline", {&cubic_spline, true}}});
      return list;
    }
  } // namespace

  InfluenceFunction::InfluenceFunction(const std::string &name)
    : function(choices().get(name).function)
    , fades_out(choices().get(name).fades_out)
  {
    // 2 pi int omega s^3 ds and 4 pi int omega s^4 ds; the halves keep the
    // spline's kink out of the Gauss rule.
    const dealii::QIterated<1> quadrature(dealii::QGauss<1>(16), 2);
    for (int dim = 2; dim <= 3; ++dim)
      {
        double integral = 0;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const double s = quadrature.point(q)[0];
            integral += quadrature.weight(q) * function(s) * std::pow(s, dim + 1);
          }
        unit_weighted_volume[dim - 2] = 2. * (dim - 1) * dealii::numbers::PI * integral;
      }
  }

  std::vector<std::string> InfluenceFunction::names()
  {
    return choices().names();
  }
} // namespace perideal
