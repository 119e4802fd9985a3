// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/neighbourhood/point_tree.h>

#include <algorithm>
#include <limits>

namespace perideal
{
  template <int dim>
  HorizonBox<dim> HorizonBox<dim>::of(const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &reach)
  {
    // An ellipsoid lies within the sphere through the corners of its box; a sphere
    // in itself.
    double largest = 0, smallest = reach[0];
    for (int d = 0; d < dim; ++d)
      {
        largest  = std::max(largest, reach[d]);
        smallest = std::min(smallest, reach[d]);
      }
    return {point, point, reach, smallest == largest ? largest : reach.norm()};
  }

  template <int dim>
  bool HorizonBox<dim>::may_interact(const HorizonBox &other) const
  {
    // A little slack, so that round-off in the box distance never loses a bond
    // whose length equals the horizon; the pair test decides.
    constexpr double slack = 1 + 1e-12;
    double           sum   = 0;
    for (int d = 0; d < dim; ++d)
      {
        const double gap = std::max({0., lower[d] - other.upper[d], other.lower[d] - upper[d]});
        if (gap > slack * std::max(reach[d], other.reach[d]))
          return false;
        sum += gap * gap;
      }
    const double radius = slack * std::max(horizon, other.horizon);
    return sum <= radius * radius;
  }

  template <int dim>
  void HorizonBox<dim>::include(const HorizonBox &other)
  {
    for (int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], other.lower[d]);
        upper[d] = std::max(upper[d], other.upper[d]);
        reach[d] = std::max(reach[d], other.reach[d]);
      }
    horizon = std::max(horizon, other.horizon);
  }

  template <int dim>
  PointTree<dim>::PointTree(const std::vector<HorizonBox<dim>> &boxes)
    : n_points(boxes.size())
  {
    if (n_points == 0)
      return;
    levels.emplace_back((n_points + leaf_size - 1) / leaf_size);
    for (LocalIndex leaf = 0; leaf < n_leaves(); ++leaf)
      {
        const LocalIndex first = leaf_begin(leaf);
        levels.front()[leaf]   = boxes[first];
        for (LocalIndex i = first + 1; i < leaf_end(leaf); ++i)
          levels.front()[leaf].include(boxes[i]);
      }
    while (levels.back().size() > 1)
      {
        const auto                  &below = levels.back();
        std::vector<HorizonBox<dim>> above((below.size() + branching - 1) / branching);
        for (std::size_t k = 0; k < below.size(); ++k)
          if (k % branching == 0)
            above[k / branching] = below[k];
          else
            above[k / branching].include(below[k]);
        levels.push_back(std::move(above));
      }
  }

  template <int dim>
  LocalIndex PointTree<dim>::leaf_end(const LocalIndex leaf) const
  {
    return std::min(n_points, (leaf + 1) * leaf_size);
  }

  template <int dim>
  void PointTree<dim>::find_leaves(const HorizonBox<dim> &box, std::vector<LocalIndex> &result) const
  {
    result.clear();
    if (levels.empty() || !box.may_interact(levels.back()[0]))
      return;
    // Level by level downwards: the order within a level is kept.
    std::vector<LocalIndex> above = {0};
    for (std::size_t level = levels.size() - 1; level-- > 0;)
      {
        result.clear();
        for (const LocalIndex parent : above)
          {
            const LocalIndex end =
              std::min<LocalIndex>((parent + 1) * branching, static_cast<LocalIndex>(levels[level].size()));
            for (LocalIndex child = parent * branching; child < end; ++child)
              if (box.may_interact(levels[level][child]))
                result.push_back(child);
          }
        above.swap(result);
      }
    result.swap(above);
  }

  template <int dim>
  std::vector<HorizonBox<dim>> PointTree<dim>::cover(const unsigned int n_boxes) const
  {
    for (const auto &level : levels)
      if (level.size() <= n_boxes)
        return level;
    return {};
  }

  PERIDEAL_INSTANTIATE_CLASS(HorizonBox)
  PERIDEAL_INSTANTIATE_CLASS(PointTree)
} // namespace perideal
