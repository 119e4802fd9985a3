// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/work_progress.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/neighbourhood/halo.h>
#include <perideal/neighbourhood/volume_rule.h>
#include <perideal/nodes/node_partitioner.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/memory_consumption.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// Coordinates of a leaf's points, one array a direction, so that the pair test below vectorises.
    template <int dim>
    struct LeafPoints
    {
      double     coordinate[dim][PointTree<dim>::leaf_size];
      double     reach_square[PointTree<dim>::leaf_size];
      LocalIndex number = 0;
    };

    template <int dim>
    LeafPoints<dim> load_leaf(const PointTree<dim>               &tree,
                              const LocalIndex                    leaf,
                              const std::vector<HorizonBox<dim>> &boxes,
                              const LocalIndex                    offset)
    {
      LeafPoints<dim>  points;
      const LocalIndex begin = tree.leaf_begin(leaf);
      points.number          = tree.leaf_end(leaf) - begin;
      for (LocalIndex k = 0; k < points.number; ++k)
        {
          const HorizonBox<dim> &box = boxes[offset + begin + k];
          for (int d = 0; d < dim; ++d)
            points.coordinate[d][k] = box.lower[d];
          points.reach_square[k] = box.horizon * box.horizon;
        }
      return points;
    }

    /// Appends the points of a leaf that are in the family of @p point.
    template <int dim>
    void append_neighbours(const LeafPoints<dim>    &leaf,
                           const LocalIndex          first_number,
                           const dealii::Point<dim> &point,
                           const double              reach_square,
                           const LocalIndex          self,
                           std::vector<LocalIndex>  &family)
    {
      double excess[PointTree<dim>::leaf_size];
      for (LocalIndex k = 0; k < leaf.number; ++k)
        {
          double length_square = 0;
          for (int d = 0; d < dim; ++d)
            {
              const double difference = leaf.coordinate[d][k] - point[d];
              length_square += difference * difference;
            }
          excess[k] = length_square - std::max(reach_square, leaf.reach_square[k]);
        }
      for (LocalIndex k = 0; k < leaf.number; ++k)
        if (excess[k] <= 0 && first_number + k != self)
          family.push_back(first_number + k);
    }
    /// Keeps the members of which @p belongs holds, without a branch: every second candidate may go.
    template <typename Predicate>
    void keep_if(std::vector<LocalIndex> &members, const Predicate &belongs)
    {
      std::size_t n_kept = 0;
      for (const LocalIndex j : members)
        {
          members[n_kept] = j;
          n_kept += belongs(j) ? 1 : 0;
        }
      members.resize(n_kept);
    }
  } // namespace

  template <int dim>
  Families<dim>::Families(const NodeCloud<dim>                         &nodes,
                          const std::shared_ptr<const VolumeRule<dim>> &rule,
                          const double                                  listed)
    : NodeArrays<dim>(nodes)
    , volume_rule(rule)
    , communicator(nodes.communicator)
    , n_owned_nodes(nodes.size())
    , first_global(nodes.first_global)
    , n_global(nodes.n_global)
    , what_is_listed{listed, {}}
  {
    search(nodes);
    count();
  }

  template <int dim>
  void Families<dim>::search(const NodeCloud<dim> &nodes)
  {
    std::vector<HorizonBox<dim>> boxes(nodes.size()), ghost_boxes;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      boxes[i] = HorizonBox<dim>::of(position[i], nodes.reach(i));
    const PointTree<dim> tree(boxes);
    const Halo<dim>      halo = exchange_halo(nodes, tree);
    cell.insert(cell.end(), halo.cells.begin(), halo.cells.end());
    for (const HaloNode<dim> &ghost : halo.nodes)
      {
        ghost_number.push_back(ghost.number);
        ghost_owner.push_back(ghost.owner);
        ghost_boxes.push_back(HorizonBox<dim>::of(ghost.position, ghost.reach));
        boxes.push_back(ghost_boxes.back());
        position.push_back(ghost.position);
        volume.push_back(ghost.volume);
        horizon.push_back(ghost.horizon);
        material.push_back(ghost.material);
        if (!shape.empty())
          shape.push_back(ghost.shape);
        spacing.push_back(ghost.spacing);
        if (!finest.empty())
          finest.push_back(ghost.finest_share);
        if (margin > 0)
          cell_radius.push_back(ghost.cell_radius);
      }
    const PointTree<dim> ghost_tree(ghost_boxes);

    row.assign(1, 0);
    row.reserve(n_owned_nodes + 1);
    std::vector<bool>                                              used(ghost_number.size(), false);
    std::vector<LocalIndex>                                        leaves;
    std::array<std::vector<LocalIndex>, PointTree<dim>::leaf_size> family;
    WorkProgress progress("finding neighbours", tree.n_leaves());
    for (LocalIndex leaf = 0; leaf < tree.n_leaves(); ++leaf)
      {
        progress(leaf);
        const LocalIndex begin = tree.leaf_begin(leaf), end = tree.leaf_end(leaf);
        for (auto &members : family)
          members.clear();
        const auto collect = [&](const PointTree<dim> &others, const LocalIndex offset) {
          others.find_leaves(tree.leaf_box(leaf), leaves);
          for (const LocalIndex other : leaves)
            {
              const auto points = load_leaf(others, other, boxes, offset);
              for (LocalIndex i = begin; i < end; ++i)
                append_neighbours(points,
                                  offset + others.leaf_begin(other),
                                  position[i],
                                  boxes[i].horizon * boxes[i].horizon,
                                  i,
                                  family[i - begin]);
            }
        };
        collect(tree, 0);
        collect(ghost_tree, n_owned_nodes);
        for (LocalIndex i = begin; i < end; ++i)
          {
            auto &members = family[i - begin];
            // The search takes more where horizons are no spheres and where they may cut cells.
            if (!shape.empty() || !cell_radius.empty())
              keep_if(members, [&](const LocalIndex j) { return are_members(i, j); });
            for (auto j = members.rbegin(); j != members.rend() && *j >= n_owned_nodes; ++j)
              used[*j - n_owned_nodes] = true;
            if (const double share = listed(); share < 1)
              keep_if(members, [&](const LocalIndex j) { return are_within(i, j, share); });
            neighbour.insert(neighbour.end(), members.begin(), members.end());
            row.push_back(neighbour.size());
          }
      }
    neighbour.shrink_to_fit();
    drop_unused_ghosts(used);
  }

  template <int dim>
  bool Families<dim>::are_within(const LocalIndex i, const LocalIndex j, const double share) const
  {
    const dealii::Tensor<1, dim> bond = position[j] - position[i];
    if (!shape.empty())
      return (shape[i] * bond).norm_square() <= share * share ||
             (shape[j] * bond).norm_square() <= share * share;
    const double radius = (1. + this->round_off) * share * std::max(horizon[i], horizon[j]);
    return bond.norm_square() <= radius * radius;
  }

  template <int dim>
  bool Families<dim>::are_members(const LocalIndex i, const LocalIndex j) const
  {
    if (cell_radius.empty())
      return are_within(i, j, 1.);
    const double length = position[j].distance(position[i]);
    return (length < horizon[i] + cell_radius[j] && volume_rule->share(*this, i, j) != 0) ||
           (length < horizon[j] + cell_radius[i] && volume_rule->share(*this, j, i) != 0);
  }

  template <int dim>
  void Families<dim>::drop_unused_ghosts(const std::vector<bool> &used)
  {
    if (ghost_number.empty())
      return;
    const LocalIndex        n_candidates = ghost_number.size();
    std::vector<LocalIndex> new_number(n_candidates);
    LocalIndex              n_used = 0;
    for (LocalIndex g = 0; g < n_candidates; ++g)
      new_number[g] = used[g] ? n_owned_nodes + n_used++ : 0;
    // Arrays that are not kept are empty.
    const auto keep_used = [&](auto &values, const LocalIndex first) {
      if (values.empty())
        return;
      LocalIndex next = first;
      for (LocalIndex g = 0; g < n_candidates; ++g)
        if (used[g])
          values[next++] = values[first + g];
      values.resize(next);
    };
    keep_used(ghost_number, 0);
    keep_used(ghost_owner, 0);
    keep_used(position, n_owned_nodes);
    keep_used(volume, n_owned_nodes);
    keep_used(horizon, n_owned_nodes);
    keep_used(shape, n_owned_nodes);
    keep_used(spacing, n_owned_nodes);
    keep_used(finest, n_owned_nodes);
    keep_used(cell_radius, n_owned_nodes);
    keep_used(cell, n_owned_nodes);
    keep_used(material, n_owned_nodes);
    for (LocalIndex &j : neighbour)
      if (j >= n_owned_nodes)
        j = new_number[j - n_owned_nodes];
  }

  template <int dim>
  void Families<dim>::count()
  {
    n_bonds_of_all =
      dealii::Utilities::MPI::sum(static_cast<GlobalIndex>(neighbour.size()), communicator) / 2;
    LocalIndex smallest = dealii::numbers::invalid_unsigned_int, largest = 0;
    for (LocalIndex i = 0; i < n_owned_nodes; ++i)
      {
        smallest = std::min(smallest, size(i));
        largest  = std::max(largest, size(i));
      }
    sizes.min  = dealii::Utilities::MPI::min(smallest, communicator);
    sizes.max  = dealii::Utilities::MPI::max(largest, communicator);
    sizes.mean = n_global == 0 ? 0. : 2. * n_bonds() / n_global;
  }

  template <int dim>
  void Families<dim>::release_members()
  {
    std::vector<LocalIndex>().swap(neighbour);
  }

  template <int dim>
  std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
  Families<dim>::make_partitioner(const unsigned int n_components) const
  {
    return make_node_partitioner(
      first_global, n_owned_nodes, n_global, ghost_number, n_components, communicator);
  }

  template <int dim>
  std::size_t Families<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(position) + memory_consumption(volume) + memory_consumption(horizon) +
           memory_consumption(material) + shape.size() * sizeof(shape[0]) + memory_consumption(spacing) +
           memory_consumption(cell_radius) + cell.size() * sizeof(CellVertices<dim>) +
           memory_consumption(row) + memory_consumption(neighbour);
  }

  PERIDEAL_INSTANTIATE_CLASS(Families)
} // namespace perideal
