// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_point_interpolation_h
#define perideal_reconstruction_point_interpolation_h

#include <perideal/base/types.h>
#include <perideal/geometry/bond_predicate.h>
#include <perideal/mesh/mesh.h>
#include <perideal/nodes/cell_graph.h>
#include <perideal/reconstruction/cell_polynomials.h>

#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Interpolates values at points of the body or its boundary from those of the nodes around.
   *
   * v(x) is the moving least squares through the vertex neighbours, of one material, of the cell that x lies
   * in, or the polynomial of the cell where values are means over cells (CellPolynomials); where x lies on a
   * face, an edge or a vertex, the mean over the cells that share it. Linear fields are reproduced, and
   * quadratic ones by polynomials.
   */
  template <int dim>
  class PointInterpolation
  {
  public:
    /// A point [m] and the parameter that asks for it.
    struct NamedPoint
    {
      std::string        parameter;
      dealii::Point<dim> position;
    };

    /// An owned node and its share of a value.
    using Share = std::pair<LocalIndex, double>;

    /// No points.
    PointInterpolation() = default;

    /// All ranks give the same points. Collective.
    /// @param is_cut whether a crack separates two nodes: values behind it do not count; empty: none does
    /// @throws InputError naming a point outside the body, and the node that is nearest to it.
    PointInterpolation(const Mesh<dim>               &mesh,
                       const CellGraph<dim>          &graph,
                       const std::vector<NamedPoint> &points,
                       const BondPredicate<dim>      &is_cut = {});

    /// The same of fields of means over cells.
    PointInterpolation(const Mesh<dim>               &mesh,
                       const CellPolynomials<dim>    &polynomials,
                       const std::vector<NamedPoint> &points);

    /// The shares of this rank's nodes in the value at each point.
    const std::vector<std::vector<Share>> &shares() const { return shares_of_points; }

    /// Values at the points of a field with dim components a node. Collective.
    std::vector<dealii::Tensor<1, dim>> evaluate(const NodalVector &field) const;

  private:
    /// Visits the cells of this rank at each point.
    /// @param add_shares (cell, point, factor, shares by local node of the graph)
    template <typename AddShares>
    void collect(const Mesh<dim>               &mesh,
                 const CellGraph<dim>          &graph,
                 const std::vector<NamedPoint> &points,
                 const AddShares               &add_shares);

    std::vector<std::vector<Share>> shares_of_points;
  };
} // namespace perideal

#endif
