// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/quadrature/bonds_through_plane.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    using dealii::numbers::PI;

    /// Bonds that are equally inclined to the normal.
    struct Cone
    {
      double cosine, sine, weight;
    };

    template <int dim>
    std::vector<Cone> make_cones(const unsigned int n_points)
    {
      const dealii::QGauss<1> gauss(n_points);
      std::vector<Cone>       result;
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const double at = gauss.point(q)[0];
          if (dim == 3)
            result.push_back({at, std::sqrt(1. - at * at), gauss.weight(q)});
          else
            result.push_back({std::cos(0.5 * PI * at), std::sin(0.5 * PI * at), 0.5 * PI * gauss.weight(q)});
        }
      return result;
    }

    /// Unit vectors normal to n, of equal weight: both in 2-D, a full turn of them in 3-D.
    template <int dim>
    std::vector<dealii::Tensor<1, dim>> make_tangents(const dealii::Tensor<1, dim> &n,
                                                      const unsigned int            n_points)
    {
      if constexpr (dim == 2)
        return {cross_product_2d(n), -cross_product_2d(n)};
      else
        {
          unsigned int across = 0;
          for (unsigned int d = 1; d < dim; ++d)
            if (std::abs(n[d]) < std::abs(n[across]))
              across = d;
          dealii::Tensor<1, dim> axis;
          axis[across]      = 1.;
          const auto first  = cross_product_3d(n, axis) / cross_product_3d(n, axis).norm();
          const auto second = cross_product_3d(n, first);

          std::vector<dealii::Tensor<1, dim>> result;
          for (unsigned int k = 0; k < n_points; ++k)
            result.push_back(std::cos(2. * PI * k / n_points) * first +
                             std::sin(2. * PI * k / n_points) * second);
          return result;
        }
    }

    /// Calls visit(point, weight) with the Gauss points of [begin, end] within the parts of a line.
    template <typename Parts, typename Visit>
    void visit_parts(const dealii::Quadrature<1> &gauss,
                     const Parts                 &parts,
                     const double                 begin,
                     const double                 end,
                     const Visit                 &visit)
    {
      for (const auto &part : parts)
        {
          const double from = std::max(begin, part.first), length = std::min(end, part.second) - from;
          if (length > 0)
            for (unsigned int q = 0; q < gauss.size(); ++q)
              visit(from + length * gauss.point(q)[0], length * gauss.weight(q));
        }
    }
  } // namespace

  template <int dim>
  std::vector<typename BondsThroughPlane<dim>::Fan>
  BondsThroughPlane<dim>::find(const dealii::Point<dim>     &x,
                               const dealii::Tensor<1, dim> &n,
                               const double                  horizon,
                               const BodyRays<dim>          &body,
                               const Orders                 &orders)
  {
    const dealii::QGauss<1> along_line(orders.line), along_bond(orders.radial);
    const auto              tangents = make_tangents<dim>(n, orders.azimuth);
    const double            turn     = dim == 3 ? 2. * PI / tangents.size() : 1.;
    const auto              line     = body.parts_inside(x, -n, horizon);

    std::vector<Fan> result;
    for (const Cone &cone : make_cones<dim>(orders.polar))
      visit_parts(along_line, line, 0., horizon * cone.cosine, [&](const double s, const double ds) {
        Fan fan;
        fan.near = x - s * n;
        for (const auto &tangent : tangents)
          {
            const auto direction = cone.cosine * n + cone.sine * tangent;
            visit_parts(along_bond,
                        body.parts_inside(fan.near, direction, horizon),
                        s / cone.cosine,
                        horizon,
                        [&](const double r, const double dr) {
                          fan.bond.push_back(r * direction);
                          fan.weight.push_back(turn * cone.weight * ds * dr * std::pow(r, dim - 1));
                        });
          }
        result.push_back(std::move(fan));
      });
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(BondsThroughPlane)
} // namespace perideal
