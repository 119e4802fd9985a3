// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/boundary/line_to_point.h>

#include <deal.II/base/quadrature_lib.h>

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
  LineToPoint::as_printed(const double sigma, const double s, const double distance) const
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

  namespace
  {
    /// Points of a face, with the area that each stands for.
    struct TractionPoint
    {
      dealii::Point<3> position;
      double           area;
    };

    std::vector<TractionPoint> points_of(const SurfaceFace<3> &face, const bool one)
    {
      if (one)
        return {{face.centre, face.area}};
      static const dealii::QGauss<2> gauss(3);
      std::vector<TractionPoint>     result;
      double                         measure = 0;
      for (const auto &at : gauss.get_points())
        {
          // Bilinear in the corners, ordered as deal.II's.
          const auto            &v = face.vertices;
          const double           x = at[0], y = at[1];
          const dealii::Point<3> position(
            (1 - x) * (1 - y) * v[0] + x * (1 - y) * dealii::Tensor<1, 3>(v[1]) +
            (1 - x) * y * dealii::Tensor<1, 3>(v[2]) + x * y * dealii::Tensor<1, 3>(v[3]));
          const auto   along_x = (1 - y) * (v[1] - v[0]) + y * (v[3] - v[2]);
          const auto   along_y = (1 - x) * (v[2] - v[0]) + x * (v[3] - v[1]);
          const double area    = gauss.weight(result.size()) * cross_product_3d(along_x, along_y).norm();
          result.push_back({position, area});
          measure += area;
        }
      for (TractionPoint &point : result)
        point.area *= face.area / measure;
      return result;
    }

    /// The tractions along the normals of faces [Pa].
    std::vector<double>
    normal_tractions(const std::vector<SurfaceFace<3>> &faces, const Loads<3> &loads, const double time)
    {
      std::vector<double> result(faces.size(), 0.);
      visit_loaded_faces(
        loads, faces, [&](const BoundaryCondition<3> &condition, const SurfaceFace<3> &face) {
          const auto   traction = Loads<3>::traction(condition, face.centre, face.normal, time);
          const double along    = traction * face.normal;
          if ((traction - along * face.normal).norm() > 1e-8 * traction.norm())
            throw InputError(
              "the closed form of the line-to-point force knows tractions along the normal only")
              .parameter("Boundary conditions/Traction treatment")
              .hint("set Boundary conditions/Treatment = taylor ghosts instead, or remove the tangential "
                    "traction of Boundary conditions/" +
                    condition.name);
          result[&face - faces.data()] += along;
        });
      return result;
    }
  } // namespace

  void add_line_to_point_forces(const NodeCloud<3>                                 &nodes,
                                const std::vector<SurfaceFace<3>>                  &faces,
                                const Loads<3>                                     &loads,
                                const double                                        time,
                                const std::function<LineToPoint(const LocalIndex)> &law_of,
                                const bool                                          as_printed,
                                NodalVector                                        &force)
  {
    const std::vector<double>               traction = normal_tractions(faces, loads, time);
    std::vector<std::vector<TractionPoint>> points;
    for (std::size_t k = 0; k < faces.size(); ++k)
      points.push_back(traction[k] != 0 ? points_of(faces[k], as_printed) : std::vector<TractionPoint>());
    visit_nearby_faces<3>(
      nodes, faces, [&](const LocalIndex i, const std::vector<const SurfaceFace<3> *> &near) {
        const LineToPoint    law = law_of(i);
        dealii::Tensor<1, 3> sum;
        for (const auto *face : near)
          {
            const std::size_t k = face - faces.data();
            for (const TractionPoint &point : points[k])
              {
                const auto   to_point = point.position - nodes.position[i];
                const double depth    = to_point * face->normal;
                const auto   across   = to_point - depth * face->normal;
                const double distance = across.norm();
                if (depth < 0)
                  continue;
                const auto density = as_printed ? law.as_printed(traction[k], depth, distance) :
                                                  law.closed_form(traction[k], depth, distance);
                sum += point.area * density.along_normal * face->normal;
                if (distance > 0)
                  sum += point.area * density.across / distance * across;
              }
          }
        for (int d = 0; d < 3; ++d)
          force.local_element(3 * i + d) += nodes.volume[i] * sum[d];
      });
  }
} // namespace perideal
