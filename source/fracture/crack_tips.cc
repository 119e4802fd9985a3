// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/crack_tips.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  namespace
  {
    /// Corners of a mesh file are the same numbers; those that a user wrote twice may differ in the last
    /// digits.
    constexpr double same = 1e-9;

    /// Corners of a segment, edges of a polygon, each with the direction away from the facet.
    template <int dim>
    std::vector<CrackEnd<dim>> rim_of(const Facet<dim> &facet)
    {
      const auto                &corners = facet.corners();
      std::vector<CrackEnd<dim>> result;
      dealii::Point<dim>         middle;
      for (const auto &corner : corners)
        middle += corner / static_cast<double>(corners.size());
      for (std::size_t k = 0; k < corners.size(); ++k)
        {
          CrackEnd<dim> end;
          end.corners = {corners[k]};
          if (dim == 3)
            end.corners.push_back(corners[(k + 1) % corners.size()]);
          end.direction = end.middle() - middle;
          if (dim == 3)
            {
              const auto along = (end.corners[1] - end.corners[0]) / end.corners[0].distance(end.corners[1]);
              end.direction -= (end.direction * along) * along;
            }
          end.direction /= end.direction.norm();
          result.push_back(end);
        }
      return result;
    }
  } // namespace

  template <int dim>
  dealii::Point<dim> CrackEnd<dim>::nearest(const dealii::Point<dim> &point) const
  {
    const auto edge = corners.back() - corners.front();
    if (edge.norm() == 0)
      return corners.front();
    return corners.front() + std::clamp((point - corners.front()) * edge / edge.norm_square(), 0., 1.) * edge;
  }

  template <int dim>
  std::vector<CrackEnd<dim>> ends_of(const std::vector<Facet<dim>> &crack, const std::size_t number)
  {
    std::vector<CrackEnd<dim>> all;
    double                     size = 0;
    for (const Facet<dim> &facet : crack)
      for (CrackEnd<dim> &end : rim_of(facet))
        {
          end.crack = number;
          all.push_back(end);
          size = std::max(size, end.middle().distance(all.front().middle()));
        }
    // By their middles, which two facets of one crack share where they meet.
    std::sort(
      all.begin(), all.end(), [](const auto &a, const auto &b) { return a.middle()[0] < b.middle()[0]; });
    std::vector<bool> is_joint(all.size(), false);
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = a + 1; b < all.size() && all[b].middle()[0] <= all[a].middle()[0] + same * size;
           ++b)
        if (all[a].middle().distance(all[b].middle()) <= same * size)
          is_joint[a] = is_joint[b] = true;
    std::vector<CrackEnd<dim>> result;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (!is_joint[k])
        result.push_back(all[k]);
    return result;
  }

  std::optional<GrowingTip> find_growing_tip(const std::vector<dealii::Point<2>> &damaged,
                                             const dealii::Point<2>              &origin,
                                             const std::vector<dealii::Point<2>> &before,
                                             const double                         length,
                                             const double                         spacing)
  {
    const auto farthest = std::max_element(damaged.begin(), damaged.end(), [&](const auto &a, const auto &b) {
      return a.distance(origin) < b.distance(origin);
    });
    if (farthest == damaged.end())
      return {};
    double                        n = 0;
    dealii::Point<2>              mean;
    dealii::SymmetricTensor<2, 2> spread;
    const auto                    for_last_part = [&](const auto &visit) {
      for (const auto *points : {&damaged, &before})
        for (const auto &point : *points)
          if (point.distance(*farthest) <= length)
            visit(point);
    };
    for_last_part([&](const auto &point) {
      mean += point;
      ++n;
    });
    mean /= n;
    for_last_part(
      [&](const auto &point) { spread += symmetrize(outer_product(point - mean, point - mean)); });

    // The axis of the larger spread.
    const double angle = 0.5 * std::atan2(2. * spread[0][1], spread[0][0] - spread[1][1]);
    GrowingTip   result;
    result.direction = dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)});
    if (result.direction * (*farthest - mean) < 0)
      result.direction *= -1.;
    const double along = std::sqrt(result.direction * (spread * result.direction) / n),
                 aside = std::sqrt(std::max(0., trace(spread) / n - along * along));
    if (!(along > 2. * aside))
      return {};
    result.position = mean + (result.direction * (*farthest - mean)) * result.direction;
    for (const auto &point : damaged)
      {
        const auto   offset = point - result.position;
        const double x      = offset * result.direction;
        if (x > spacing || (offset - x * result.direction).norm() > 1.5 * spacing + 0.05 * std::abs(x))
          result.straight = std::min(result.straight, offset.norm());
      }
    return result;
  }

  template struct CrackEnd<2>;
  template struct CrackEnd<3>;
  PERIDEAL_INSTANTIATE(ends_of)
} // namespace perideal
