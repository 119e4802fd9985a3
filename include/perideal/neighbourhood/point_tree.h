// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_point_tree_h
#define perideal_neighbourhood_point_tree_h

#include <perideal/base/types.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>

#include <vector>

namespace perideal
{
  /// Bounds some points and the largest horizon among them.
  template <int dim>
  struct HorizonBox
  {
    dealii::Point<dim> lower, upper;
    /// How far the horizons of the points inside reach along each axis, at most [m].
    dealii::Tensor<1, dim> reach;
    /// Radius of spheres around these horizons [m].
    double horizon = 0;

    /// The box around a node.
    static HorizonBox of(const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &reach);
    /// True when a point of one box may be in the family of a point of the other (union rule).
    bool may_interact(const HorizonBox &other) const;
    void include(const HorizonBox &other);
  };

  /**
   * Builds a hierarchy of bounding boxes over points that are numbered along a
   * space-filling curve: leaves are runs of consecutive points, so that nothing
   * is sorted or stored twice, and graded meshes cost no more than uniform ones
   * (cells of a fixed width would fill up where the mesh is fine).
   */
  template <int dim>
  class PointTree
  {
  public:
    /// Points in a leaf.
    static constexpr LocalIndex leaf_size = 16;

    /// @param boxes around one point each, in the order of the points
    explicit PointTree(const std::vector<HorizonBox<dim>> &boxes);

    LocalIndex n_leaves() const
    {
      return levels.empty() ? 0 : static_cast<LocalIndex>(levels.front().size());
    }
    const HorizonBox<dim> &leaf_box(const LocalIndex leaf) const { return levels.front()[leaf]; }
    LocalIndex             leaf_begin(const LocalIndex leaf) const { return leaf * leaf_size; }
    LocalIndex             leaf_end(const LocalIndex leaf) const;

    /// Leaves that may interact with a box, in ascending order, into @p result.
    void find_leaves(const HorizonBox<dim> &box, std::vector<LocalIndex> &result) const;

    /// A covering by at most about @p n_boxes boxes.
    std::vector<HorizonBox<dim>> cover(const unsigned int n_boxes) const;

  private:
    static constexpr LocalIndex branching = 8;

    LocalIndex n_points;
    /// Boxes by level, leaves first, one box at the top.
    std::vector<std::vector<HorizonBox<dim>>> levels;
  };
} // namespace perideal

#endif
