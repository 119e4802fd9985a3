// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/generators.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace perideal
{
  namespace
  {
    /// Boundary ids in the order of the names left, right, bottom, top, back, front, hole.
    template <int dim>
    void name_boundaries(const dealii::Point<dim> &extent, CoarseMesh<dim> &mesh)
    {
      const dealii::types::boundary_id hole = 2 * dim;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              dealii::types::boundary_id id     = hole;
              const auto                 centre = face->center();
              for (unsigned int d = 0; d < dim; ++d)
                if (std::abs(std::abs(centre[d]) - extent[d]) < 1e-10 * extent[d])
                  id = 2 * d + (centre[d] > 0 ? 1 : 0);
              face->set_boundary_id(id);
            }
      mesh.boundary_names = {{"left", 0}, {"right", 1}, {"bottom", 2}, {"top", 3}, {"hole", hole}};
      if (dim == 3)
        mesh.boundary_names.insert({{"back", 4}, {"front", 5}});
    }

    /// The hole takes some cells, and leaves those at the edges.
    template <int dim>
    void check_radius(const double                     radius,
                      const dealii::Point<dim>        &extent,
                      const std::vector<unsigned int> &counts)
    {
      // Distances of the nearest cell's centre and of the edge's nearest one.
      double nearest = 0, edge = extent.norm();
      for (unsigned int d = 0; d < 2; ++d)
        {
          const double half_cell = extent[d] / counts[d];
          nearest                = std::hypot(nearest, counts[d] % 2 == 0 ? half_cell : 0.);
          edge                   = std::min(edge, extent[d] - half_cell);
        }
      if (!(radius > nearest && radius < edge))
        throw InputError("the hole must take cells, but none at the edges")
          .parameter("Mesh/Hole radius")
          .allowed("between " + std::to_string(nearest) + " and " + std::to_string(edge) +
                   " m, where centres of cells lie");
    }
  } // namespace

  template <int dim>
  void generate_plate_with_hole_grid(const MeshParameters &parameters, CoarseMesh<dim> &mesh)
  {
    const auto counts =
      cell_counts(parameters,
                  dim == 2 ? std::vector<unsigned int>{100, 100} : std::vector<unsigned int>{100, 100, 10},
                  dim == 2 ? "counts along x, y" : "counts along x, y, z");
    const auto         size = lengths(parameters,
                              dim == 2 ? std::vector<double>{1., 1.} : std::vector<double>{1., 1., 0.1},
                              dim == 2 ? "lengths along x, y [m], > 0" : "lengths along x, y, z [m], > 0");
    dealii::Point<dim> extent;
    for (unsigned int d = 0; d < dim; ++d)
      extent[d] = size[d] / 2;
    check_radius(parameters.hole_radius, extent, counts);

    dealii::Triangulation<dim> full;
    dealii::GridGenerator::subdivided_hyper_rectangle(full, counts, -extent, extent);
    // The round-off that centres on the circle may have takes all of them or none.
    const double radius = parameters.hole_radius * (1 + 1e-10);
    std::set<typename dealii::Triangulation<dim>::active_cell_iterator> in_hole;
    for (const auto &cell : full.active_cell_iterators())
      {
        const auto centre = cell->center();
        if (std::hypot(centre[0], centre[1]) <= radius)
          in_hole.insert(cell);
      }
    dealii::GridGenerator::create_triangulation_with_removed_cells(full, in_hole, mesh.triangulation);
    name_boundaries(extent, mesh);
  }

  PERIDEAL_INSTANTIATE(generate_plate_with_hole_grid)
} // namespace perideal
