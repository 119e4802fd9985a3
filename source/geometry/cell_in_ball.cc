// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/geometry/cell_in_ball.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  namespace
  {
    /// Vertices around the faces of a hexahedron, counterclockwise as seen from outside.
    constexpr unsigned int around_face[6][4] = {
      {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    /// Vertices around a quadrilateral.
    constexpr unsigned int around_cell[4] = {0, 1, 3, 2};

    /**
     * A directed edge in the plane of a polygon: its points lie at p m + t e from the foot of the ball's
     * centre in that plane, e along the edge, m across it, away from the polygon.
     */
    template <int dim>
    struct Edge
    {
      dealii::Tensor<1, dim> e, m;
      double                 p, begin, end;
    };

    /// What the edges of a polygon add up to.
    template <int dim>
    struct EdgeSums
    {
      /// Area between the foot and the parts of edges within the disk, and its first moment about the foot.
      double                 area = 0;
      dealii::Tensor<1, dim> moment;
      /// Angles under which the other parts are seen from the foot, the integral of the unit vector over
      /// them, and the solid angle of the triangles between the foot and these parts.
      double                 angle = 0, solid_angle = 0;
      dealii::Tensor<1, dim> arc;
    };

    /// Angle from (x1, y1) to (x2, y2), both with x >= 0.
    double angle_between(const double x1, const double y1, const double x2, const double y2)
    {
      return std::atan2(x1 * y2 - x2 * y1, x1 * x2 + y1 * y2);
    }

    template <int dim, bool with_moment>
    void add_inside(const Edge<dim> &edge, const double t1, const double t2, EdgeSums<dim> &sums)
    {
      const double area = 0.5 * edge.p * (t2 - t1);
      sums.area += area;
      if constexpr (with_moment)
        sums.moment += area / 3. * (2. * edge.p * edge.m + (t1 + t2) * edge.e);
    }

    /// @param height of the ball's centre over the plane, absolute; solid angles are of three dimensions
    /// @param is_cut whether the plane cuts the ball
    template <int dim, bool with_moment>
    void add_outside(const Edge<dim> &edge,
                     const double     t1,
                     const double     t2,
                     const double     height,
                     const bool       is_cut,
                     EdgeSums<dim>   &sums)
    {
      const double sign = edge.p < 0 ? -1. : 1., p = std::abs(edge.p);
      if constexpr (dim == 3)
        {
          // phi - asin(h sin(phi)/sqrt(h^2 + p^2)) at either end, as one angle without cancellation.
          const auto x = [&](const double t, const double l) { return p * p * l + height * t * t; };
          const auto y = [&](const double t, const double l) {
            return t * p * (t * t + p * p) / (l + height);
          };
          const double l1 = std::sqrt(height * height + p * p + t1 * t1);
          const double l2 = std::sqrt(height * height + p * p + t2 * t2);
          // A centre in the plane, at a vertex, sees nothing of what is next to it.
          if (p > 0)
            sums.solid_angle += sign * angle_between(x(t1, l1), y(t1, l1), x(t2, l2), y(t2, l2));
        }
      if (is_cut)
        {
          sums.angle += sign * angle_between(p, t1, p, t2);
          if constexpr (with_moment)
            {
              const double r1 = std::sqrt(p * p + t1 * t1), r2 = std::sqrt(p * p + t2 * t2);
              sums.arc += (t2 / r2 - t1 / r1) * edge.m - sign * (p / r2 - p / r1) * edge.e;
            }
        }
    }

    /// Splits an edge at the disk.
    /// @param square of the disk's radius; not above 0: there is none
    template <int dim, bool with_moment>
    void add_edge(const Edge<dim> &edge, const double square, const double height, EdgeSums<dim> &sums)
    {
      const double rest   = square - edge.p * edge.p;
      const bool   is_cut = square > 0;
      if (rest <= 0)
        return add_outside<dim, with_moment>(edge, edge.begin, edge.end, height, is_cut, sums);
      const double t     = std::sqrt(rest);
      const double begin = std::max(edge.begin, -t), end = std::min(edge.end, t);
      if (edge.begin < -t)
        add_outside<dim, with_moment>(edge, edge.begin, std::min(edge.end, -t), height, is_cut, sums);
      if (begin < end)
        add_inside<dim, with_moment>(edge, begin, end, sums);
      if (edge.end > t)
        add_outside<dim, with_moment>(edge, std::max(edge.begin, t), edge.end, height, is_cut, sums);
    }

    /// The cone between the ball's centre, the origin, and a face, as far as it lies within the ball.
    /// @param radius infinite: all of the cone
    template <bool with_moment>
    void add_cone(const PlaneFace &face, const double radius, CellMoments<3> &result)
    {
      const auto  &c      = face.corner;
      const auto   normal = face.n_corners == 4 ? cross_product_3d(c[2] - c[0], c[3] - c[1]) :
                                                  cross_product_3d(c[1] - c[0], c[2] - c[0]);
      const double norm   = normal.norm();
      if (norm == 0)
        return;
      const auto   n      = normal / norm;
      const double h      = n * c[0];
      const double height = std::abs(h);
      const double square = (radius - height) * (radius + height);
      EdgeSums<3>  sums;
      for (unsigned int k = 0; k < face.n_corners; ++k)
        {
          const auto  &a = c[k], &b = c[k + 1 == face.n_corners ? 0 : k + 1];
          const double length = a.distance(b);
          if (length == 0)
            continue;
          Edge<3> edge;
          edge.e     = (b - a) / length;
          edge.m     = cross_product_3d(edge.e, n);
          edge.p     = edge.m * a;
          edge.begin = edge.e * a;
          edge.end   = edge.begin + length;
          add_edge<3, with_moment>(edge, square, height, sums);
        }
      if (std::isinf(radius))
        {
          result.volume += h / 3. * sums.area;
          result.moment += h / 4. * (sums.area * h * n + sums.moment);
          return;
        }
      // Outside, the cone to the disk's sector and the part of the ball up to the edge: the sector of the
      // ball less that of the cap behind the disk, (d - h)^2 (2 d + h)/6 by angle.
      const double cap =
        square > 0 ? (radius - height) * (radius - height) * (2. * radius + height) / 6. : 0.;
      result.volume +=
        h / 3. * sums.area +
        (h < 0 ? -1. : 1.) * (radius * radius * radius / 3. * sums.solid_angle - cap * sums.angle);
      if (with_moment && square > 0)
        {
          // Of the ball's surface within the cell, the integral of the unit normal is half the closed
          // integral of r x dr, to which only the arcs on faces add: along edges neighbouring faces cancel.
          // What they add has the form of the disk's sectors.
          const double d2 = radius * radius, disk = std::sqrt(square);
          result.moment += h / 4. * (sums.area * h * n + sums.moment) +
                           (h * h - d2) * square * sums.angle / 8. * n +
                           (h * square * disk / 12. + d2 * h * disk / 8.) * sums.arc;
        }
    }

    template <bool with_moment>
    CellMoments<3> sum_up(const CellVertices<3> &cell, const double radius)
    {
      CellMoments<3>            result;
      std::array<PlaneFace, 24> faces;
      const unsigned int        n_faces = plane_faces(cell, faces);
      for (unsigned int f = 0; f < n_faces; ++f)
        add_cone<with_moment>(faces[f], radius, result);
      return result;
    }

    template <bool with_moment>
    CellMoments<2> sum_up(const CellVertices<2> &cell, const double radius)
    {
      EdgeSums<2> sums;
      for (unsigned int k = 0; k < 4; ++k)
        {
          const auto  &a = cell[around_cell[k]], &b = cell[around_cell[(k + 1) % 4]];
          const double length = a.distance(b);
          if (length == 0)
            continue;
          Edge<2> edge;
          edge.e     = (b - a) / length;
          edge.m     = cross_product_2d(edge.e);
          edge.p     = edge.m * a;
          edge.begin = edge.e * a;
          edge.end   = edge.begin + length;
          add_edge<2, with_moment>(edge, radius * radius, 0., sums);
        }
      if (std::isinf(radius))
        return {sums.area, sums.moment};
      return {sums.area + 0.5 * radius * radius * sums.angle,
              sums.moment + radius * radius * radius / 3. * sums.arc};
    }

    template <int dim>
    CellVertices<dim> relative_to(const CellVertices<dim> &cell, const dealii::Point<dim> &origin)
    {
      CellVertices<dim> result;
      for (unsigned int v = 0; v < cell.size(); ++v)
        result[v] = dealii::Point<dim>(cell[v] - origin);
      return result;
    }

    template <int dim, bool with_moment>
    CellMoments<dim>
    sums_in_ball(const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius)
    {
      const PlaceOfCell place = place_of(cell, centre, radius);
      if (place == PlaceOfCell::outside)
        return {};
      auto result =
        sum_up<with_moment>(relative_to(cell, centre),
                            place == PlaceOfCell::inside ? std::numeric_limits<double>::infinity() : radius);
      result.moment += result.volume * centre;
      return result;
    }
  } // namespace

  unsigned int plane_faces(const CellVertices<3> &cell, std::array<PlaneFace, 24> &faces)
  {
    // Warp below which a face is plane, over its size [-].
    constexpr double round_off = 1e-13;
    unsigned int     n         = 0;
    for (const auto &around : around_face)
      {
        const auto &a = cell[around[0]], &b = cell[around[1]], &c = cell[around[2]], &d = cell[around[3]];
        const auto  normal = cross_product_3d(c - a, d - b);
        const auto  warp   = (b - a) - (c - d);
        // |warp . n| over the size, squared twice as a normal is an area.
        if (std::abs(warp * normal) <= round_off * normal.norm() * std::sqrt(normal.norm()))
          {
            faces[n++] = {{a, b, c, d}, 4};
            continue;
          }
        const dealii::Point<3> mean(0.25 * (((a - b) + (c - b)) + (d - b)) + b);
        for (unsigned int k = 0; k < 4; ++k)
          faces[n++] = {{cell[around[k]], cell[around[(k + 1) % 4]], mean, mean}, 3};
      }
    return n;
  }

  template <int dim>
  PlaceOfCell place_of(const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius)
  {
    double                 farthest = 0, nearest = 0;
    dealii::Tensor<1, dim> lower = cell[0] - centre, upper = lower;
    for (const auto &vertex : cell)
      {
        const auto r = vertex - centre;
        farthest     = std::max(farthest, r.norm_square());
        for (int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], r[d]);
            upper[d] = std::max(upper[d], r[d]);
          }
      }
    if (farthest <= radius * radius)
      return PlaceOfCell::inside;
    for (int d = 0; d < dim; ++d)
      {
        const double gap = std::max({0., lower[d], -upper[d]});
        nearest += gap * gap;
      }
    return nearest >= radius * radius ? PlaceOfCell::outside : PlaceOfCell::perhaps_cut;
  }

  template <int dim>
  double cell_volume(const CellVertices<dim> &cell)
  {
    return sum_up<false>(relative_to(cell, cell[0]), std::numeric_limits<double>::infinity()).volume;
  }

  template <int dim>
  double volume_in_ball(const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius)
  {
    return sums_in_ball<dim, false>(cell, centre, radius).volume;
  }

  template <int dim>
  CellMoments<dim>
  moments_in_ball(const CellVertices<dim> &cell, const dealii::Point<dim> &centre, const double radius)
  {
    return sums_in_ball<dim, true>(cell, centre, radius);
  }

  PERIDEAL_INSTANTIATE(place_of)
  PERIDEAL_INSTANTIATE(cell_volume)
  PERIDEAL_INSTANTIATE(volume_in_ball)
  PERIDEAL_INSTANTIATE(moments_in_ball)

} // namespace perideal
