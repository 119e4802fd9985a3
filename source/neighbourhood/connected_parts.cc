// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/types.h>
#include <perideal/neighbourhood/components.h>
#include <perideal/neighbourhood/connected_parts.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <set>
#include <utility>

namespace perideal
{
  namespace
  {
    /// Marks nodes that are no cells': images and nodes on the surface.
    constexpr unsigned int no_part = -1;
  } // namespace

  template <int dim>
  std::vector<unsigned int> ConnectedParts<dim>::parts_of_coarse_cells(const Mesh<dim> &mesh)
  {
    // Every rank has all coarse cells, and refinement joins and parts nothing.
    Components cells(mesh.triangulation.n_cells(0));
    for (const auto &cell : mesh.triangulation.cell_iterators_on_level(0))
      for (const unsigned int f : cell->face_indices())
        if (!cell->at_boundary(f))
          cells.join(cell->index(), cell->neighbor(f)->index());
    return cells.number().first;
  }

  template <int dim>
  ConnectedParts<dim>::ConnectedParts(const Mesh<dim>          &mesh,
                                      const Nodes<dim>         &nodes,
                                      const Families<dim>      &families,
                                      const BondPredicate<dim> &is_cut)
  {
    const std::vector<unsigned int> part_of_cell = parts_of_coarse_cells(mesh);
    n_parts = n_bodies = 1 + *std::max_element(part_of_cell.begin(), part_of_cell.end());
    if (n_parts == 1)
      return;
    std::vector<unsigned int> part_of_node(families.n_owned(), no_part);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          typename dealii::Triangulation<dim>::cell_iterator coarse = cell;
          while (coarse->level() > 0)
            coarse = coarse->parent();
          part_of_node[nodes.node_of_cell[cell->active_cell_index()]] = part_of_cell[coarse->index()];
        }
    join(families, part_of_node, is_cut);
  }

  template <int dim>
  void ConnectedParts<dim>::join(const Families<dim>             &families,
                                 const std::vector<unsigned int> &part_of_node,
                                 const BondPredicate<dim>        &is_cut)
  {
    NodalVector of_all(families.make_partitioner(1));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      of_all.local_element(i) = part_of_node[i];
    of_all.update_ghost_values();
    std::set<std::pair<unsigned int, unsigned int>> found;
    GlobalIndex                                     n_ends = 0;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
        if (const auto a = part_of_node[i], b = static_cast<unsigned int>(of_all.local_element(*j));
            a != b && a != no_part && b != no_part &&
            !(is_cut && is_cut(families.position[i], families.position[*j])))
          {
            found.insert({a, b});
            ++n_ends;
          }
    n_bonds_across = dealii::Utilities::MPI::sum(n_ends, families.communicator) / 2;
    Components parts(n_parts);
    parts.join_all(found, families.communicator);
    const auto numbered = parts.number();
    n_bodies            = numbered.second;
    body_of_node.resize(families.n_owned());
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      body_of_node[i] = part_of_node[i] == no_part ? 0 : numbered.first[part_of_node[i]];
  }

  PERIDEAL_INSTANTIATE_CLASS(ConnectedParts)
} // namespace perideal
