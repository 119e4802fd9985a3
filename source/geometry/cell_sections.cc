// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/geometry/cell_in_ball.h>
#include <perideal/geometry/cell_sections.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Kinks nearer to each other than this are one, over the range of all [-].
    constexpr double round_off = 1e-12;

    /// Sorts, keeps what lies within the limits, adds these and joins what round-off parts.
    void tidy(std::vector<double> &kinks, const double lower, const double upper)
    {
      const double unit = round_off * (upper - lower);
      kinks.erase(std::remove_if(kinks.begin(),
                                 kinks.end(),
                                 [&](const double at) { return !(at > lower + unit && at < upper - unit); }),
                  kinks.end());
      if (!(lower < upper))
        return;
      std::sort(kinks.begin(), kinks.end());
      kinks.erase(std::unique(kinks.begin(),
                              kinks.end(),
                              [&](const double a, const double b) { return b - a <= unit; }),
                  kinks.end());
      kinks.insert(kinks.begin(), lower);
      kinks.push_back(upper);
    }

    /// Where a segment crosses the surface of a ball about the origin: visit(share of the way).
    template <int dim, typename Visit>
    void visit_crossings(const dealii::Point<dim> &a,
                         const dealii::Point<dim> &b,
                         const double              radius_square,
                         const Visit              &visit)
    {
      const auto   way    = b - a;
      const double square = way.norm_square();
      if (square == 0)
        return;
      const double middle = -(dealii::Tensor<1, dim>(a) * way) / square;
      const double rest =
        middle * middle - (dealii::Tensor<1, dim>(a).norm_square() - radius_square) / square;
      if (rest <= 0)
        return;
      for (const double share : {middle - std::sqrt(rest), middle + std::sqrt(rest)})
        if (share > 0 && share < 1)
          visit(share);
    }
  } // namespace

  void DiskedPolygon::find_kinks(std::vector<double> &kinks) const
  {
    kinks.clear();
    const bool   has_disk = std::isfinite(radius_square);
    const double radius   = std::sqrt(std::max(0., radius_square));
    double       lower = 1e300, upper = -1e300;
    for (const Side &side : sides)
      {
        for (const auto *end : {&side.a, &side.b})
          {
            lower = std::min(lower, (*end)[0]);
            upper = std::max(upper, (*end)[0]);
            // Limits follow the disk at corners outside.
            if (end->square() <= (1. + round_off) * radius_square)
              kinks.push_back((*end)[0]);
          }
        if (has_disk)
          visit_crossings(side.a, side.b, radius_square, [&](const double share) {
            kinks.push_back(side.a[0] + share * (side.b[0] - side.a[0]));
          });
      }
    if (has_disk)
      {
        lower = std::max(lower, -radius);
        upper = std::min(upper, radius);
      }
    tidy(kinks, lower, upper);
  }

  void DiskedPolygon::find_chords(const double y, std::vector<Interval> &chords) const
  {
    chords.clear();
    const double square = radius_square - y * y;
    if (square <= 0)
      return;
    const double half = std::sqrt(square);
    crossings.clear();
    for (const Side &side : sides)
      if ((side.a[0] <= y) != (side.b[0] <= y))
        crossings.push_back(side.a[1] + (y - side.a[0]) / (side.b[0] - side.a[0]) * (side.b[1] - side.a[1]));
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      {
        const double begin = std::max(crossings[k], -half), end = std::min(crossings[k + 1], half);
        if (begin < end)
          chords.push_back({begin, end});
      }
  }

  bool DiskedPolygon::ends_at_disk(const double y) const
  {
    std::vector<Interval> chords;
    find_chords(y, chords);
    const double half = std::sqrt(std::max(0., radius_square - y * y));
    return !chords.empty() && (chords.front().begin == -half || chords.back().end == half);
  }

  CellSections<2>::CellSections(const CellVertices<2> &cell, const double radius)
  {
    polygon.radius_square = radius * radius;
    for (const auto &ends : {std::array<unsigned int, 2>{0, 1}, {1, 3}, {3, 2}, {2, 0}})
      polygon.sides.push_back({cell[ends[0]], cell[ends[1]]});
  }

  CellSections<3>::CellSections(const CellVertices<3> &cell, const double radius)
    : radius(radius)
  {
    std::array<PlaneFace, 24> plane;
    const unsigned int        n_faces = plane_faces(cell, plane);
    for (unsigned int f = 0; f < n_faces; ++f)
      faces.push_back({{plane[f].corner.begin(), plane[f].corner.begin() + plane[f].n_corners}});
    find_kinks();
  }

  bool
  CellSections<3>::is_on(const Face &face, const dealii::Point<3> &point, const dealii::Tensor<1, 3> &normal)
  {
    const auto &c = face.corners;
    for (std::size_t k = 0; k < c.size(); ++k)
      {
        const auto side = c[(k + 1) % c.size()] - c[k];
        if (cross_product_3d(side, point - c[k]) * normal < -round_off * side.norm_square())
          return false;
      }
    return true;
  }

  void CellSections<3>::find_kinks()
  {
    const double square = radius * radius;
    double       lower = 1e300, upper = -1e300;
    for (const Face &face : faces)
      for (std::size_t k = 0; k < face.corners.size(); ++k)
        {
          const auto &a = face.corners[k], &b = face.corners[(k + 1) % face.corners.size()];
          lower = std::min(lower, a[0]);
          upper = std::max(upper, a[0]);
          if (a.square() <= (1. + round_off) * square)
            all_kinks.push_back(a[0]);
          if (std::isfinite(radius))
            visit_crossings(
              a, b, square, [&](const double share) { all_kinks.push_back(a[0] + share * (b[0] - a[0])); });
        }
    if (std::isfinite(radius))
      {
        for (const Face &face : faces)
          {
            // Where a face's circle ends along x, sections lose a side.
            const auto &c      = face.corners;
            auto        normal = cross_product_3d(c[1] - c[0], c[2] - c[0]);
            normal /= normal.norm();
            const double height = normal * dealii::Tensor<1, 3>(c[0]);
            const double across = 1. - normal[0] * normal[0], disk = square - height * height;
            if (across <= round_off || disk <= 0)
              continue;
            auto along = -normal[0] * normal;
            along[0] += 1.;
            for (const double sign : {-1., 1.})
              {
                const dealii::Point<3> end(height * normal + sign * std::sqrt(disk / across) * along);
                all_roots.push_back(end[0]);
                if (is_on(face, end, normal))
                  all_kinks.push_back(end[0]);
              }
          }
        lower = std::max(lower, -radius);
        upper = std::min(upper, radius);
      }
    tidy(all_kinks, lower, upper);
  }

  const DiskedPolygon &CellSections<3>::section(const double x) const
  {
    polygon.radius_square = radius * radius - x * x;
    polygon.sides.clear();
    for (const Face &face : faces)
      {
        DiskedPolygon::Side side;
        unsigned int        n = 0;
        for (std::size_t k = 0; k < face.corners.size(); ++k)
          {
            const auto &a = face.corners[k], &b = face.corners[(k + 1) % face.corners.size()];
            if ((a[0] <= x) != (b[0] <= x) && n < 2)
              {
                const double share           = (x - a[0]) / (b[0] - a[0]);
                (n++ == 0 ? side.a : side.b) = {a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])};
              }
          }
        if (n == 2)
          polygon.sides.push_back(side);
      }
    return polygon;
  }
} // namespace perideal
