// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/geometry/facets.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// How far beyond its edge a facet reaches, over its size: a segment through the edge crosses.
    constexpr double edge_tolerance = 1e-9;

    /// Up to so many facets it is faster to try them all.
    constexpr std::size_t few = 8;

    namespace bgi = boost::geometry::index;

    /// The box around points, larger by a margin on every side.
    template <int dim>
    dealii::BoundingBox<dim> box_around(const std::vector<dealii::Point<dim>> &points, const double margin)
    {
      dealii::BoundingBox<dim> box(points);
      box.extend(margin);
      return box;
    }
  } // namespace

  template <int dim>
  Facet<dim>::Facet(const std::vector<dealii::Point<dim>> &corners)
    : points(corners)
  {
    Assert(points.size() >= dim && (dim == 3 || points.size() == 2),
           dealii::ExcMessage("a segment has two corners, a polygon three or more"));
    for (const auto &point : points)
      size = std::max(size, point.distance(points[0]));
    if constexpr (dim == 2)
      normal = cross_product_2d(points[1] - points[0]);
    else
      for (std::size_t k = 1; k + 1 < points.size(); ++k)
        normal += cross_product_3d(points[k] - points[0], points[k + 1] - points[0]);
    const double measure = normal.norm();
    if (measure > 1e-12 * std::pow(size, dim - 1))
      normal /= measure;
    else
      normal = 0.;
  }

  template <int dim>
  bool Facet<dim>::is_valid() const
  {
    for (std::size_t k = 0; k < n_edges(); ++k)
      if (points[k].distance(points[(k + 1) % points.size()]) == 0)
        return false;
    return normal.norm() > 0 && std::all_of(points.begin(), points.end(), [&](const auto &point) {
             return std::abs((point - points[0]) * normal) <= 1e-6 * size;
           });
  }

  template <int dim>
  bool Facet<dim>::is_crossed(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const
  {
    const double at_a = (a - points[0]) * normal, at_b = (b - points[0]) * normal;
    return (at_a < 0) != (at_b < 0) && contains(a + at_a / (at_a - at_b) * (b - a));
  }

  template <int dim>
  dealii::Point<dim> Facet<dim>::nearest_of_edge(const std::size_t k, const dealii::Point<dim> &point) const
  {
    const auto  &p    = points[k];
    const auto   edge = points[(k + 1) % points.size()] - p;
    const double at   = std::clamp((point - p) * edge / edge.norm_square(), 0., 1.);
    return p + at * edge;
  }

  template <int dim>
  bool Facet<dim>::contains(const dealii::Point<dim> &x) const
  {
    for (std::size_t k = 0; k < n_edges(); ++k)
      if (x.distance(nearest_of_edge(k, x)) <= edge_tolerance * size)
        return true;
    bool inside = false;
    if constexpr (dim == 3)
      {
        // Drop the coordinate along which the plane is seen best.
        unsigned int largest = 0;
        for (unsigned int d = 1; d < 3; ++d)
          if (std::abs(normal[d]) > std::abs(normal[largest]))
            largest = d;
        const unsigned int u = (largest + 1) % 3, v = (largest + 2) % 3;
        for (std::size_t k = 0; k < points.size(); ++k)
          {
            const auto &p = points[k], &q = points[(k + 1) % points.size()];
            if ((p[v] > x[v]) != (q[v] > x[v]) && x[u] < p[u] + (x[v] - p[v]) / (q[v] - p[v]) * (q[u] - p[u]))
              inside = !inside;
          }
      }
    return inside;
  }

  template <int dim>
  double Facet<dim>::distance(const dealii::Point<dim> &point) const
  {
    if constexpr (dim == 3)
      {
        const double height = (point - points[0]) * normal;
        if (contains(point - height * normal))
          return std::abs(height);
      }
    double result = point.distance(nearest_of_edge(0, point));
    for (std::size_t k = 1; k < n_edges(); ++k)
      result = std::min(result, point.distance(nearest_of_edge(k, point)));
    return result;
  }

  template <int dim>
  Facets<dim>::Facets(const std::vector<Facet<dim>> &facets)
    : facets(facets)
  {
    std::vector<Entry> entries;
    for (const Facet<dim> &facet : facets)
      entries.emplace_back(dealii::BoundingBox<dim>(facet.corners()), entries.size());
    tree = dealii::pack_rtree(entries);
  }

  template <int dim>
  bool Facets<dim>::are_crossed(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const
  {
    if (facets.size() <= few)
      return std::any_of(
        facets.begin(), facets.end(), [&](const Facet<dim> &facet) { return facet.is_crossed(a, b); });
    // A segment through the very edge of a facet may pass its box by round-off.
    const auto box = box_around<dim>({a, b}, 1e-6 * a.distance(b));
    return std::any_of(tree.qbegin(bgi::intersects(box)), tree.qend(), [&](const Entry &near) {
      return facets[near.second].is_crossed(a, b);
    });
  }

  template <int dim>
  bool Facets<dim>::are_within(const double distance, const dealii::Point<dim> &point) const
  {
    const auto box = box_around<dim>({point}, distance);
    return std::any_of(tree.qbegin(bgi::intersects(box)), tree.qend(), [&](const Entry &near) {
      return facets[near.second].distance(point) <= distance;
    });
  }

  PERIDEAL_INSTANTIATE_CLASS(Facet)
  PERIDEAL_INSTANTIATE_CLASS(Facets)
} // namespace perideal
