// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_connected_parts_h
#define perideal_neighbourhood_connected_parts_h

#include <perideal/geometry/bond_predicate.h>
#include <perideal/mesh/mesh.h>
#include <perideal/neighbourhood/families.h>
#include <perideal/nodes/nodes.h>

#include <vector>

namespace perideal
{
  /**
   * Finds the disconnected bodies of a mesh. Parts are sets of cells connected by faces; bonds may join
   * several of them to one body, across gaps that are narrower than the horizon. All ranks know the same
   * numbers; nodes are those of each rank.
   */
  template <int dim>
  struct ConnectedParts
  {
    /// Collective.
    /// @param is_cut whether a precrack cuts the bond between two places; empty: none does
    ConnectedParts(const Mesh<dim>          &mesh,
                   const Nodes<dim>         &nodes,
                   const Families<dim>      &families,
                   const BondPredicate<dim> &is_cut);

    unsigned int n_parts = 1, n_bodies = 1;
    /// Of owned nodes, numbered from 0; empty in a body of one part.
    std::vector<unsigned int> body_of_node;
    /// Bonds of all ranks between parts.
    GlobalIndex n_bonds_across = 0;

  private:
    /// The part of each coarse cell, by index.
    static std::vector<unsigned int> parts_of_coarse_cells(const Mesh<dim> &mesh);
    /// Makes bodies of the parts that bonds join.
    void join(const Families<dim>             &families,
              const std::vector<unsigned int> &part_of_node,
              const BondPredicate<dim>        &is_cut);
  };
} // namespace perideal

#endif
