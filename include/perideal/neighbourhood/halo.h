// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_halo_h
#define perideal_neighbourhood_halo_h

#include <perideal/neighbourhood/point_tree.h>
#include <perideal/nodes/nodes.h>

#include <vector>

namespace perideal
{
  /// Holds what one rank sends another of one of its nodes.
  template <int dim>
  struct HaloNode
  {
    GlobalIndex                number;
    unsigned int               owner;
    dealii::Point<dim>         position;
    double                     volume, horizon, spacing, finest_share;
    dealii::types::material_id material;
    /// Zero where families hold the nodes within horizons.
    double cell_radius;
    /// Zero where horizons are spheres.
    dealii::Tensor<2, dim> shape;
    dealii::Tensor<1, dim> reach;
  };

  template <int dim>
  struct Halo
  {
    std::vector<HaloNode<dim>> nodes;
    /// Their cells where the cloud has cells, else empty.
    std::vector<CellVertices<dim>> cells;
  };

  /**
   * Returns the nodes of other ranks that may share a bond with an owned one, ascending by
   * global number. The halo may have any width: ranks tell each other boxes around their
   * nodes and send what lies within the larger horizon of a box. Collective.
   */
  template <int dim>
  Halo<dim> exchange_halo(const NodeCloud<dim> &nodes, const PointTree<dim> &tree);
} // namespace perideal

#endif
