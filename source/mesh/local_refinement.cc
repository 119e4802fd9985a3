// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/local_refinement.h>
#include <perideal/parameters/space_time_function.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/tria_base.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace perideal
{
  namespace
  {
    template <int dim>
    using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;

    /// Vertices on the boundaries. The ghost cells include all neighbours of a
    /// vertex, and with them the faces that an own cell touches with a vertex only.
    template <int dim>
    std::vector<bool> boundary_vertices(const std::set<dealii::types::boundary_id> &boundaries,
                                        const dealii::Triangulation<dim>           &triangulation)
    {
      std::vector<bool> result(triangulation.n_vertices(), false);
      for (const auto &cell : triangulation.active_cell_iterators())
        if (!cell->is_artificial() && cell->at_boundary())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && boundaries.count(face->boundary_id()) > 0)
              for (const unsigned int v : face->vertex_indices())
                result[face->vertex_index(v)] = true;
      return result;
    }

    /// Flags own cells with one of the vertices and adds the vertices of all
    /// cells so flagged, on any rank. Returns the number of own flagged cells.
    template <int dim>
    std::uint64_t flag_layer(std::vector<bool> &vertices, dealii::Triangulation<dim> &triangulation)
    {
      std::uint64_t     n_flagged = 0;
      std::vector<bool> grown     = vertices;
      const auto        add       = [&](const Cell<dim> &cell) {
        for (const unsigned int v : cell->vertex_indices())
          grown[cell->vertex_index(v)] = true;
      };
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            const auto indices = cell->vertex_indices();
            if (std::any_of(indices.begin(), indices.end(), [&](const unsigned int v) {
                  return vertices[cell->vertex_index(v)];
                }))
              {
                cell->set_refine_flag();
                add(cell);
                ++n_flagged;
              }
          }
      if (dynamic_cast<const dealii::parallel::TriangulationBase<dim> *>(&triangulation) != nullptr)
        dealii::GridTools::exchange_cell_data_to_ghosts<char, dealii::Triangulation<dim>>(
          triangulation,
          [](const Cell<dim> &cell) { return static_cast<char>(cell->refine_flag_set()); },
          [&](const Cell<dim> &cell, const char flagged) {
            if (flagged != 0)
              add(cell);
          });
      vertices = grown;
      return n_flagged;
    }

    /// Flags own cells with their centre or a vertex where a formula is not zero. Returns the number of those
    /// that were not flagged before.
    template <int dim>
    std::uint64_t flag_places(const SpaceTimeFunction<dim> &where, dealii::Triangulation<dim> &triangulation)
    {
      const auto    is_there  = [&](const dealii::Point<dim> &x) { return where.value(x, 0.) != 0.; };
      std::uint64_t n_flagged = 0;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && !cell->refine_flag_set())
          {
            const auto indices = cell->vertex_indices();
            if (is_there(cell->center()) ||
                std::any_of(indices.begin(), indices.end(), [&](const unsigned int v) {
                  return is_there(cell->vertex(v));
                }))
              {
                cell->set_refine_flag();
                ++n_flagged;
              }
          }
      return n_flagged;
    }
  } // namespace

  template <int dim>
  void refine_locally(const LocalRefinement &refinement, dealii::Triangulation<dim> &triangulation)
  {
    const SpaceTimeFunction<dim> where(refinement.where, "Mesh/Refine where");
    for (unsigned int time = 0; time < refinement.times; ++time)
      {
        std::uint64_t     n_flagged = 0;
        std::vector<bool> vertices  = boundary_vertices(refinement.boundaries, triangulation);
        for (unsigned int layer = 0; layer < refinement.layers; ++layer)
          n_flagged = flag_layer(vertices, triangulation);
        if (where.is_present())
          n_flagged += flag_places(where, triangulation);
        const double n_cells = static_cast<double>(triangulation.n_global_active_cells()) +
                               (dealii::GeometryInfo<dim>::max_children_per_cell - 1.) *
                                 dealii::Utilities::MPI::sum(n_flagged, triangulation.get_communicator());
        // Cells are numbered with 32 bits.
        if (n_cells > 4e9)
          throw InputError("so many refinements make " + std::to_string(n_cells) + " cells")
            .parameter("Mesh/Refine times")
            .allowed("up to 4,000,000,000 cells in all");
        triangulation.execute_coarsening_and_refinement();
      }
  }

  PERIDEAL_INSTANTIATE(refine_locally)
} // namespace perideal
