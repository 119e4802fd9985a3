// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/crack_path.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  CrackPath<dim>::CrackPath(const dealii::Point<dim>     &origin,
                            const dealii::Tensor<1, dim> &side,
                            const double                  radius)
    : origin(origin)
    , side(side)
    , radius(radius)
  {
  }

  template <int dim>
  template <typename Visit>
  void CrackPath<dim>::for_neighbours(const std::size_t k, const Visit &visit) const
  {
    namespace bgi = boost::geometry::index;
    // Cells that share a corner are up to sqrt(dim) spacings apart.
    const double             factor   = 1.1 * std::sqrt(double(dim));
    const auto              &position = all[k].position;
    dealii::BoundingBox<dim> box({position, position});
    box.extend(factor * largest_spacing);
    for (auto near = tree.qbegin(bgi::intersects(box)); near != tree.qend(); ++near)
      if (near->first.distance(position) <= factor * std::max(all[k].spacing, all[near->second].spacing))
        visit(near->second);
  }

  template <int dim>
  void CrackPath<dim>::add(const std::vector<DamagedNode<dim>> &more)
  {
    const std::size_t first = all.size();
    for (const auto &node : more)
      {
        tree.insert({node.position, all.size()});
        all.push_back(node);
        largest_spacing = std::max(largest_spacing, node.spacing);
      }
    connected.resize(all.size(), false);

    const std::size_t        n_before = path.size();
    std::vector<std::size_t> front;
    const auto               connect = [&](const std::size_t k) {
      connected[k] = true;
      front.push_back(k);
      const auto from_origin = all[k].position - origin;
      if (from_origin.norm() <= radius && (side.norm() == 0 || from_origin * side > 0))
        path.push_back(all[k]);
    };
    for (std::size_t k = first; k < all.size(); ++k)
      {
        bool joins = all[k].position.distance(origin) < 4 * all[k].spacing;
        for_neighbours(k, [&](const std::size_t near) { joins = joins || connected[near]; });
        if (joins && !connected[k])
          connect(k);
        while (!front.empty())
          {
            const std::size_t from = front.back();
            front.pop_back();
            for_neighbours(from, [&](const std::size_t near) {
              if (!connected[near])
                connect(near);
            });
          }
      }
    std::sort(path.begin() + n_before, path.end());
    std::inplace_merge(path.begin(), path.begin() + n_before, path.end());
  }

  template <int dim>
  std::vector<DamagedNode<dim>> CrackPath<dim>::tip_arrivals() const
  {
    std::vector<DamagedNode<dim>> result;
    for (const auto &node : path)
      // Of nodes as far as each other, which round-off tells apart, the first.
      if (result.empty() || distance(node) > distance(result.back()) + 1e-6 * node.spacing)
        result.push_back(node);
    return result;
  }

  template <int dim>
  double CrackPath<dim>::speed(const double time) const
  {
    const auto arrivals = tip_arrivals();
    if (arrivals.empty())
      return 0.;
    const double reach = distance(arrivals.back());
    auto         since = arrivals.begin();
    while (since + 1 != arrivals.end() &&
           distance(*(since + 1)) <= reach - n_spacings * arrivals.back().spacing)
      ++since;
    return time > since->time ? (reach - distance(*since)) / (time - since->time) : 0.;
  }

  PERIDEAL_INSTANTIATE_CLASS(CrackPath)
} // namespace perideal
