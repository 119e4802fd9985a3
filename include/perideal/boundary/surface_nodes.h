// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_surface_nodes_h
#define perideal_boundary_surface_nodes_h

#include <perideal/boundary/boundary_faces.h>

#include <vector>

namespace perideal
{
  /**
   * Nodes on the surface where displacements are prescribed (PDBC section 5.1): one at the centroid of each
   * boundary face that a condition holds in some component, with volume, spacing, horizon and
   * material of the node of its cell - a fictitious volume, which the body does not have. Held components
   * have the prescribed values, the others are unknowns as those of any node.
   */
  template <int dim>
  class SurfaceNodes
  {
  public:
    /// Collective.
    SurfaceNodes(const NodeCloud<dim>                 &real,
                 const std::vector<BoundaryFace<dim>> &faces,
                 const Loads<dim>                     &loads);

    /// The nodes of cells first, then those on the surface of this rank.
    const NodeCloud<dim> &nodes() const { return all; }

    /// The faces that conditions hold, each with its own node.
    const std::vector<BoundaryFace<dim>> &faces() const { return held_faces; }

    /// The nodes of their cells.
    const std::vector<LocalIndex> &cell_nodes() const { return nodes_of_cells; }

  private:
    NodeCloud<dim>                 all;
    std::vector<BoundaryFace<dim>> held_faces;
    std::vector<LocalIndex>        nodes_of_cells;
  };
} // namespace perideal

#endif
