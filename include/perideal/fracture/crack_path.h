// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_crack_path_h
#define perideal_fracture_crack_path_h

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <utility>
#include <vector>

namespace perideal
{
  /// A node, the time at which it became damaged [s], its spacing [m].
  template <int dim>
  struct DamagedNode
  {
    dealii::Point<dim> position;
    double             time = 0, spacing = 0;

    /// By time, then by position: an order that depends neither on ranks nor on when they are collected.
    bool operator<(const DamagedNode &other) const
    {
      for (int d = 0; d < dim; ++d)
        if (time == other.time && position[d] != other.position[d])
          return position[d] < other.position[d];
      return time < other.time;
    }

    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &position &time &spacing;
    }
  };

  /// Follows one crack as it grows: the damaged nodes that are connected, cell by cell, with a
  /// node near its origin. For one rank.
  template <int dim>
  class CrackPath
  {
  public:
    /// @param side vector towards the nodes that count; zero: all do
    /// @param radius largest distance from the origin of nodes that count [m]
    CrackPath(const dealii::Point<dim> &origin, const dealii::Tensor<1, dim> &side, const double radius);

    /// Adds damaged nodes, of this crack or not; each is given once.
    void add(const std::vector<DamagedNode<dim>> &more);

    /// The nodes that count, by time.
    const std::vector<DamagedNode<dim>> &nodes() const { return path; }

    double distance(const DamagedNode<dim> &node) const { return node.position.distance(origin); }

    /// Those of the nodes that the tip came to, each farther from the origin than the one before.
    std::vector<DamagedNode<dim>> tip_arrivals() const;

    /// How fast the tip is at a time not before its last arrival [m/s]: its way since it was n_spacings of
    /// its spacing nearer to the origin, or since the crack began, over the time since.
    double speed(const double time) const;

    static constexpr double n_spacings = 8;

  private:
    using Entry = std::pair<dealii::Point<dim>, std::size_t>;

    /// Calls visit(k) for the nodes whose cells share a corner with that of node @p k.
    template <typename Visit>
    void for_neighbours(const std::size_t k, const Visit &visit) const;

    dealii::Point<dim>     origin;
    dealii::Tensor<1, dim> side;
    double                 radius, largest_spacing = 0;

    std::vector<DamagedNode<dim>> all, path;
    std::vector<bool>             connected;
    dealii::RTree<Entry>          tree;
  };
} // namespace perideal

#endif
