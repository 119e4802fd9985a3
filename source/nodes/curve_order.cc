// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/nodes/curve_order.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace perideal
{
  template <int dim>
  std::vector<LocalIndex> order_along_curve(const std::vector<dealii::Point<dim>> &points)
  {
    if (points.empty())
      return {};
    // As many bits a direction as fit into one key.
    constexpr int bits = 64 / dim;
    // One scale for all directions: on points, deal.II's function would give each its own, and
    // nodes of a long body that follow each other would lie far apart.
    const dealii::BoundingBox<dim> box(points);
    double                         extent = 1e-300;
    for (int d = 0; d < dim; ++d)
      extent = std::max(extent, box.side_length(d));
    const double                                scale = (std::pow(2., bits) - 1.) * (1. - 1e-15) / extent;
    std::vector<std::array<std::uint64_t, dim>> grid(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int d = 0; d < dim; ++d)
        grid[i][d] = static_cast<std::uint64_t>((points[i][d] - box.lower_bound(d)) * scale);
    const auto keys = dealii::Utilities::inverse_Hilbert_space_filling_curve<dim>(grid, bits);
    std::vector<std::pair<std::uint64_t, LocalIndex>> order(points.size());
    for (LocalIndex i = 0; i < points.size(); ++i)
      order[i] = {dealii::Utilities::pack_integers<dim>(keys[i], bits), i};
    std::sort(order.begin(), order.end());
    std::vector<LocalIndex> result(points.size());
    std::transform(
      order.begin(), order.end(), result.begin(), [](const auto &entry) { return entry.second; });
    return result;
  }

  PERIDEAL_INSTANTIATE(order_along_curve)
} // namespace perideal
