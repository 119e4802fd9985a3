// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_mesh_parent_mesh_h
#define perideal_mesh_parent_mesh_h

#include <perideal/geometry/bond_predicate.h>
#include <perideal/mesh/mesh.h>

#include <memory>

namespace perideal
{
  /// Whether cells of the mesh have parents: whether it was refined.
  template <int dim>
  bool has_parents(const Mesh<dim> &mesh);

  /// Cells of create_parent_mesh(), but for those that must stay fine beside
  /// cells finer still, or at cracks. Collective.
  template <int dim>
  dealii::types::global_cell_index n_parent_cells(const Mesh<dim> &mesh);

  /**
   * Creates the mesh coarsened once: of each active cell of the mesh it has the parent
   * or, beside finer cells and where there is no parent, the cell itself. A
   * rank owns the cells of which it owns the (first) child in the mesh, so that
   * it finds the cell of each of its own by CellId. Collective.
   *
   * @param is_cut whether a crack parts the middles of two cells; empty: none does. Parents whose children it
   *   parts stay divided, and so do those that share a vertex with them, so that no hanging vertex lies on
   *   the crack.
   */
  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>> create_parent_mesh(const Mesh<dim>          &mesh,
                                                                 const BondPredicate<dim> &is_cut = {});
} // namespace perideal

#endif
