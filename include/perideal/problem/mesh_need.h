// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_problem_mesh_need_h
#define perideal_problem_mesh_need_h

#include <perideal/parameters/space_time_function.h>
#include <perideal/problem/problem.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <set>
#include <vector>

namespace perideal
{
  /**
   * Knows where a body needs its smallest cells at a time: around nodes whose bonds come near their limits,
   * around the edges of precracks, at boundaries and in groups of cells that the scene names, and where a
   * formula says so. It holds no reference to the problem.
   */
  template <int dim>
  class MeshNeed
  {
  public:
    using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;

    /// Looks at a problem with nodes and, where it has one, at its force. Places that moved since the mesh
    /// changed last go on so: small cells also lie where they are to come to. Collective.
    /// @param needed_before owned nodes that needed small cells then; none of any rank: nothing is known
    /// @param exponents singular_exponents()
    MeshNeed(const Problem<dim>        &problem,
             const double               time,
             const std::vector<bool>   &needed_before,
             const std::vector<double> &exponents);

    /// Whether a cell lies where cells are to be halved so often at least: within the reach of a place that
    /// needs small cells, or so near to it that no family meets three sizes of cells, which would make some
    /// bonds stiff and explicit steps several times shorter.
    /// @param halvings of the cell
    bool needs(const Cell &cell, const unsigned int halvings, const unsigned int wanted) const;

    /// The widest layers of cells of sizes between around any cell of a mesh, and the diameter of its largest
    /// cell [m].
    struct Widths
    {
      double layers, cell;
    };
    /// Collective.
    Widths largest_widths(const Mesh<dim> &mesh) const;

    /// Whether a cell may be halved, be it by p4est beside others that are, or is within a distance [m] of
    /// one that may.
    bool is_near_halved(const Cell &cell, const Widths &largest, const double distance) const;

    /// How far a cell has to be from one that stays as it is to be joined with its sisters [m]: no bond of
    /// the larger cell may pass what broke there, and layers of cells of each size between are to lie around
    /// it.
    /// @param halvings of the cell
    /// @param of_kept those of the other
    double distance_to_join(const Cell &cell, const unsigned int halvings, const unsigned int of_kept) const;

    /// Whether it lies so near that it is to be small now: within half of the reach.
    bool is_urgent(const Cell &cell) const { return is_in(urgent, cell, 0.); }

    /// By owned node: whether bonds are far enough below their limits for larger cells.
    std::vector<bool> is_quiet;
    /// By owned node: whether it needs small cells around it.
    std::vector<bool> needs_small;
    /// Whether any are ever joined.
    bool may_join = false;

  private:
    using Boxes = dealii::RTree<dealii::BoundingBox<dim>>;

    /// How wide the layers of cells of sizes between are to be [m]: of those halved @p first times and more,
    /// but not @p last times.
    /// @param halvings of a cell, whose size tells those of the others
    double width_of_layers(const Cell        &cell,
                           const unsigned int halvings,
                           const unsigned int first,
                           const unsigned int last) const;
    /// @param margin around the boxes [m]
    bool is_in(const Boxes &boxes, const Cell &cell, const double margin) const;

    SpaceTimeFunction<dim> where;
    double                 time;
    unsigned int           levels;
    /// layers_between_sizes(), and the horizon over the spacing.
    double layers, horizon_factor;
    /// Of cells that are to be small.
    std::set<dealii::types::material_id> groups;
    /// Around nodes, edges and boundaries; and of the regions, where the formula says so, in parts of cells
    /// of the mesh that was looked at, and where a group ends.
    Boxes within_reach, urgent, of_regions;
  };
} // namespace perideal

#endif
