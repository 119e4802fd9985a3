// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_geometry_facets_h
#define perideal_geometry_facets_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <utility>
#include <vector>

namespace perideal
{
  /// Represents a segment in 2-D, a plane polygon in 3-D; its edge belongs to it.
  template <int dim>
  class Facet
  {
  public:
    /// @param corners two in 2-D, three or more around the polygon in 3-D [m]
    explicit Facet(const std::vector<dealii::Point<dim>> &corners);

    /// Whether the corners make a facet at all: apart from each other, and in one plane.
    bool is_valid() const;

    /// Whether the segment between two points passes through. A point in the facet's line or plane belongs to
    /// one side of it, so that a segment that ends there crosses for one side only.
    bool is_crossed(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const;

    /// Distance of a point [m].
    double distance(const dealii::Point<dim> &point) const;

    const std::vector<dealii::Point<dim>> &corners() const { return points; }

  private:
    /// Whether a point of the facet's line or plane is in the facet.
    bool contains(const dealii::Point<dim> &point) const;
    /// The point of edge k next to a point.
    dealii::Point<dim> nearest_of_edge(const std::size_t k, const dealii::Point<dim> &point) const;
    std::size_t        n_edges() const { return dim == 2 ? 1 : points.size(); }

    std::vector<dealii::Point<dim>> points;
    /// Unit normal, zero where there is none, and size [m].
    dealii::Tensor<1, dim> normal;
    double                 size = 0;
  };

  /// Holds facets in a search tree, so that only nearby ones are tested.
  template <int dim>
  class Facets
  {
  public:
    explicit Facets(const std::vector<Facet<dim>> &facets);

    const std::vector<Facet<dim>> &all() const { return facets; }

    /// Whether the segment between two points passes through one of them.
    bool are_crossed(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const;

    /// Whether one of them is at most so far from a point [m].
    bool are_within(const double distance, const dealii::Point<dim> &point) const;

  private:
    using Entry = std::pair<dealii::BoundingBox<dim>, unsigned int>;

    std::vector<Facet<dim>> facets;
    dealii::RTree<Entry>    tree;
  };
} // namespace perideal

#endif
