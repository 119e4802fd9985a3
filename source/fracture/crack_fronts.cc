// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/fracture/crack_fronts.h>
#include <perideal/neighbourhood/components.h>

#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace perideal
{
  namespace
  {
    /// Loss over the largest of a step from which on a node belongs to a front.
    constexpr double noticed = 1e-3;
    /// Distance from a front, over its horizon, up to which motion goes wholly with it, and beyond which it
    /// stays where it was.
    constexpr double whole = 2., outermost = 4.;

    template <int dim>
    dealii::BoundingBox<dim> box_around(const dealii::Point<dim> &point, const double reach)
    {
      dealii::BoundingBox<dim> box({point, point});
      box.extend(reach);
      return box;
    }

    /// The index of the point that is nearest to another one.
    template <typename Tree, int dim>
    std::size_t nearest(const Tree &tree, const dealii::Point<dim> &point)
    {
      std::vector<std::size_t> found;
      tree.query(boost::geometry::index::nearest(point, 1), std::back_inserter(found));
      return found.front();
    }

    /// The ways to some places from the nearest ones before; zero where it is farther than a reach [m].
    template <int dim>
    std::vector<dealii::Tensor<1, dim>> ways_between(const std::vector<dealii::Point<dim>> &before,
                                                     const std::vector<dealii::Point<dim>> &now,
                                                     const double                           reach)
    {
      std::vector<dealii::Tensor<1, dim>> result;
      const auto                          tree = dealii::pack_rtree_of_indices(before);
      for (const auto &place : now)
        {
          const auto way = place - before[nearest(tree, place)];
          result.push_back(way.norm() <= reach ? way : dealii::Tensor<1, dim>());
        }
      return result;
    }
  } // namespace

  template <int dim>
  CrackFronts<dim>::CrackFronts(const NodeCloud<dim> &nodes)
    : nodes(nodes)
  {
  }

  template <int dim>
  void CrackFronts<dim>::begin(const std::vector<double> &now)
  {
    damage = now;
    lost.resize(damage.size());
    lost_before.resize(damage.size());
  }

  template <int dim>
  void CrackFronts<dim>::note(const std::vector<double> &now)
  {
    lost_before.swap(lost);
    std::transform(now.begin(), now.end(), damage.begin(), lost.begin(), std::minus<double>());
    damage = now;
  }

  template <int dim>
  void CrackFronts<dim>::register_state(LastingState &state)
  {
    state.add_node_array(
      "damage in the last load step",
      "1",
      1,
      [this] { return lost; },
      [this](const std::vector<double> &read) { lost = read; });
    state.add_node_array(
      "damage in the load step before",
      "1",
      1,
      [this] { return lost_before; },
      [this](const std::vector<double> &read) { lost_before = read; });
  }

  template <int dim>
  typename CrackFronts<dim>::Fronts CrackFronts<dim>::find(const std::vector<double> &of_step) const
  {
    double largest = of_step.empty() ? 0. : *std::max_element(of_step.begin(), of_step.end());
    largest        = dealii::Utilities::MPI::max(largest, nodes.communicator);
    std::vector<std::pair<dealii::Point<dim>, std::pair<double, double>>> own;
    for (LocalIndex i = 0; i < of_step.size(); ++i)
      if (of_step[i] > noticed * largest)
        own.push_back({nodes.position[i], {nodes.horizon[i], nodes.volume[i] * of_step[i]}});
    Fronts              result;
    std::vector<double> weight;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(nodes.communicator, own))
      for (const auto &[point, numbers] : of_rank)
        {
          result.points.push_back(point);
          result.horizon = std::max(result.horizon, numbers.first);
          weight.push_back(numbers.second);
        }
    Components               connected(result.points.size());
    const auto               tree = dealii::pack_rtree_of_indices(result.points);
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < result.points.size(); ++k)
      {
        found.clear();
        tree.query(boost::geometry::index::intersects(box_around(result.points[k], result.horizon)),
                   std::back_inserter(found));
        for (const std::size_t l : found)
          connected.join(k, l);
      }
    const auto [numbers, n_fronts] = connected.number();
    result.front                   = numbers;
    result.centres.resize(n_fronts);
    std::vector<double> sum(n_fronts, 0.);
    for (std::size_t k = 0; k < result.points.size(); ++k)
      {
        result.centres[result.front[k]] += weight[k] * result.points[k];
        sum[result.front[k]] += weight[k];
      }
    for (unsigned int f = 0; f < n_fronts; ++f)
      result.centres[f] /= sum[f];
    return result;
  }

  template <int dim>
  bool CrackFronts<dim>::carry(const NodalVector &motion, NodalVector &carried) const
  {
    const Fronts now = find(lost), before = find(lost_before);
    if (now.points.empty() || before.points.empty())
      return false;
    // Where motion goes with a front, and from where it may come.
    const double reach   = outermost * now.horizon;
    const auto   ways    = ways_between(before.centres, now.centres, reach);
    double       longest = 0;
    for (const auto &way : ways)
      longest = std::max(longest, way.norm());
    if (longest == 0.)
      return false;
    struct Moved
    {
      LocalIndex             node;
      double                 share;
      dealii::Tensor<1, dim> way;
    };
    std::vector<Moved>                                                 moved;
    std::vector<std::pair<dealii::Point<dim>, dealii::Tensor<1, dim>>> own;
    const auto               tree = dealii::pack_rtree_of_indices(now.points);
    dealii::BoundingBox<dim> around(std::make_pair(now.points[0], now.points[0]));
    for (const auto &point : now.points)
      around.merge_with(box_around(point, reach + longest));
    for (LocalIndex i = 0; i < damage.size(); ++i)
      {
        const auto &x = nodes.position[i];
        if (!around.point_inside(x))
          continue;
        const std::size_t k        = nearest(tree, x);
        const double      distance = x.distance(now.points[k]);
        if (distance > reach + longest)
          continue;
        dealii::Tensor<1, dim> value;
        for (int d = 0; d < dim; ++d)
          value[d] = motion.local_element(dim * i + d);
        own.emplace_back(x, value);
        if (distance < reach && ways[now.front[k]].norm() > 0)
          moved.push_back({i,
                           std::min(1., (outermost - distance / now.horizon) / (outermost - whole)),
                           ways[now.front[k]]});
      }
    std::vector<dealii::Point<dim>>     points;
    std::vector<dealii::Tensor<1, dim>> values;
    for (const auto &of_rank : dealii::Utilities::MPI::all_gather(nodes.communicator, own))
      for (const auto &[point, value] : of_rank)
        {
          points.push_back(point);
          values.push_back(value);
        }
    const auto sources = dealii::pack_rtree_of_indices(points);
    carried            = motion;
    for (const Moved &here : moved)
      {
        const auto        from = nodes.position[here.node] - here.way;
        const std::size_t k    = nearest(sources, from);
        if (from.distance(points[k]) < nodes.spacing[here.node])
          for (int d = 0; d < dim; ++d)
            {
              double &own_value = carried.local_element(dim * here.node + d);
              own_value += here.share * (values[k][d] - own_value);
            }
      }
    return true;
  }

  PERIDEAL_INSTANTIATE_CLASS(CrackFronts)
} // namespace perideal
