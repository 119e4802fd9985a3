// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_gauss_points_h
#define perideal_quadrature_gauss_points_h

#include <perideal/neighbourhood/families.h>

#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Places fixed Gauss points in the cells of nodes (QUAD 3.3): the same for every bond to a cell, n in each
   * direction. A point g stands for a subcell of volume V_g = w_g |det J| and width D_g, the edge of the
   * square or cube of this measure; where a horizon cuts subcells, it counts
   *
   *     beta_g = min(1, max(0, (d + D_g/2 - |x_g - x|)/D_g))                        (3.14)
   *
   * of them. ((3.13) and what follows from it have the volume twice: the sum is that of beta_g f V_g.)
   * Displacements at the points follow from those of the nodes around by moving least squares.
   *
   * Nodes are the local ones of the families, which must reach as far as the cells that horizons cut.
   */
  template <int dim>
  class GaussPoints
  {
  public:
    /// Places the points; displacements need a further call. Collective.
    /// @param n points in each direction
    GaussPoints(const Mesh<dim>     &mesh,
                const Nodes<dim>    &nodes,
                const Families<dim> &families,
                const unsigned int   n);

    /// Finds the weights with which nodes give displacements at the points. Collective.
    /// @param support_radius of moving least squares, in spacings of the cell [-]
    /// @throws InputError on all ranks where the nodes around a point make no quadratic fit.
    void fit(const Nodes<dim> &nodes, const double support_radius);

    /// Points of a cell.
    unsigned int n_points() const { return n_of_cell; }

    /// Of the points of the cell of a local node: one coordinate, volumes, in 2-D area times thickness, and
    /// widths [m].
    const double *coordinate(const LocalIndex j, const int d) const
    {
      return coordinates.begin() + (dim * j + d) * n_of_cell;
    }
    const double *volume(const LocalIndex j) const { return volumes.begin() + j * n_of_cell; }
    const double *width(const LocalIndex j) const { return widths.begin() + j * n_of_cell; }

    /// Displacements at the points of all local cells, laid out like coordinates, from those of owned nodes
    /// (dim values each). Collective.
    void interpolate(const NodalVector &displacement, NodalVector &at_points) const;

    /// A vector for interpolate().
    void initialize(NodalVector &at_points) const { at_points.reinit(coordinates.get_partitioner()); }

    /// Nodes that make the displacements in the cell of an owned node, by global number, and the weights they
    /// have there: n_points() of each.
    std::vector<GlobalIndex> support(const LocalIndex j) const;
    const double *weights(const LocalIndex j) const { return weight.data() + first[j] * n_of_cell; }

    /// The nodes of other ranks among them, as entries of a field with dim values a node.
    const dealii::IndexSet &ghosts() const { return ghosted.get_partitioner()->ghost_indices(); }

    std::size_t memory_consumption() const;

  private:
    void place_points(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const unsigned int n);

    unsigned int n_of_cell;
    LocalIndex   n_owned;
    NodalVector  coordinates, volumes, widths;

    /// The nodes of supports of all owned cells, row after row, in the layout of the work space.
    std::vector<BondIndex>   first;
    std::vector<LocalIndex>  column;
    std::vector<GlobalIndex> global_number;
    std::vector<double>      weight;
    mutable NodalVector      ghosted;
  };

  /// Calls visit(j) for a node and the others whose cells its horizon may cut.
  template <int dim, typename Visit>
  void visit_cells(const Families<dim> &families, const LocalIndex i, const Visit &visit)
  {
    visit(i);
    for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
      visit(*j);
  }

  /// sum beta V |xi| over the points of a family: int |xi| dV by the quadrature [m^4].
  template <int dim>
  double first_moment(const Families<dim> &families, const GaussPoints<dim> &points, const LocalIndex i);
} // namespace perideal

#endif
