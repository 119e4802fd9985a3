// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/generators.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace perideal
{
  namespace
  {
    /// Geometry of the plate and the numbering of its vertices: the radial
    /// index runs fastest, then the one around, then the layer.
    struct Plate
    {
      double       half_side, radius, grading, depth;
      unsigned int around, radial, layers;

      unsigned int n_around() const { return 8 * around; }

      unsigned int vertex(const unsigned int layer, const unsigned int ring, const unsigned int r) const
      {
        return (layer * n_around() + ring % n_around()) * (radial + 1) + r;
      }

      /// g(t) = (q^t - 1)/(q - 1), the geometric grading; t for q = 1.
      double graded(const double t) const
      {
        const double log_q = std::log(grading);
        return std::abs(log_q) < 1e-12 ? t : std::expm1(t * log_q) / std::expm1(log_q);
      }

      /// Position in the first octant: s from the x axis to the diagonal, t from
      /// the hole to the edge of the square.
      dealii::Point<2> first_octant(const double s, const double t) const
      {
        const double           g     = graded(t);
        const double           angle = s * dealii::numbers::PI_4;
        const dealii::Point<2> inner(radius * std::cos(angle), radius * std::sin(angle));
        const dealii::Point<2> outer(half_side, half_side * s);
        dealii::Point<2>       x = inner + g * (outer - inner);
        if (s == 1.)
          x[1] = x[0];
        return x;
      }

      /// All octants are images of the first under swaps and signs, so that the
      /// mesh is symmetric to the last bit.
      dealii::Point<2> position(const unsigned int ring, const unsigned int r) const
      {
        const unsigned int octant = ring / around, quadrant = octant / 2;
        const double       s = static_cast<double>(ring % around) / around;
        const double       t = static_cast<double>(r) / radial;

        dealii::Point<2> x = first_octant(octant % 2 == 0 ? s : mirrored(ring), t);
        if (octant % 2 == 1)
          x = dealii::Point<2>(x[1], x[0]);
        switch (quadrant)
          {
          case 1:
            return dealii::Point<2>(-x[1], x[0]);
          case 2:
            return dealii::Point<2>(-x[0], -x[1]);
          case 3:
            return dealii::Point<2>(x[1], -x[0]);
          default:
            return x;
          }
      }

      /// 1 - s, formed from the counts so that it equals its mirror image's s.
      double mirrored(const unsigned int ring) const
      {
        return static_cast<double>(around - ring % around) / around;
      }
    };

    template <int dim>
    Plate plate_of(const MeshParameters &parameters)
    {
      const std::vector<unsigned int> counts =
        cell_counts(parameters,
                    dim == 2 ? std::vector<unsigned int>{30, 32} : std::vector<unsigned int>{30, 32, 4},
                    dim == 2 ? "cells around each of the eight blocks, cells radially" :
                               "cells around each of the eight blocks, cells radially, layers in z");
      const std::vector<double> size =
        lengths(parameters,
                dim == 2 ? std::vector<double>{1.} : std::vector<double>{1., 0.1},
                dim == 2 ? "side of the square [m], > 0" : "side of the square, depth in z [m], > 0");
      const double radius = parameters.hole_radius, half_side = size[0] / 2;
      if (!(radius > 0 && radius < half_side))
        throw InputError("the hole must fit into the plate")
          .parameter("Mesh/Hole radius")
          .allowed("between 0 and half the side, " + std::to_string(half_side) + " m");
      const double depth  = dim == 3 ? size.back() : 0.;
      const auto   layers = dim == 3 ? counts.back() : 0;
      return {half_side, radius, parameters.grading, depth, counts[0], counts[1], layers};
    }

    template <int dim>
    std::vector<dealii::Point<dim>> vertices_of(const Plate &plate)
    {
      std::vector<dealii::Point<dim>> vertices;
      for (unsigned int layer = 0; layer <= plate.layers; ++layer)
        for (unsigned int ring = 0; ring < plate.n_around(); ++ring)
          for (unsigned int r = 0; r <= plate.radial; ++r)
            {
              const dealii::Point<2> x = plate.position(ring, r);
              dealii::Point<dim>     vertex;
              vertex[0] = x[0];
              vertex[1] = x[1];
              // from both faces alike, so that z is symmetric to the last bit
              if constexpr (dim == 3)
                vertex[2] = plate.depth *
                            (static_cast<double>(layer) - static_cast<double>(plate.layers - layer)) /
                            (2. * plate.layers);
              vertices.push_back(vertex);
            }
      return vertices;
    }

    template <int dim>
    std::vector<dealii::CellData<dim>> cells_of(const Plate &plate)
    {
      std::vector<dealii::CellData<dim>> cells;
      for (unsigned int layer = 0; layer < std::max(1u, plate.layers); ++layer)
        for (unsigned int ring = 0; ring < plate.n_around(); ++ring)
          for (unsigned int r = 0; r < plate.radial; ++r)
            {
              dealii::CellData<dim> cell;
              for (unsigned int v = 0; v < cell.vertices.size(); ++v)
                cell.vertices[v] = plate.vertex(layer + v / 4, ring + v / 2 % 2, r + v % 2);
              cells.push_back(cell);
            }
      return cells;
    }

    /// Boundary ids in the order of the names left, right, bottom, top, back, front, hole.
    template <int dim>
    void name_boundaries(const Plate &plate, CoarseMesh<dim> &mesh)
    {
      const dealii::types::boundary_id hole = 2 * dim;
      dealii::Point<dim>               extent;
      extent[0] = extent[1] = plate.half_side;
      if (dim == 3)
        extent[dim - 1] = plate.depth / 2;
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            {
              dealii::types::boundary_id id = hole;
              for (unsigned int d = 0; d < dim; ++d)
                if (std::abs(std::abs(face->center()[d]) - extent[d]) < 1e-10 * extent[d])
                  id = 2 * d + (face->center()[d] > 0 ? 1 : 0);
              face->set_boundary_id(id);
            }
      mesh.boundary_names = {{"left", 0}, {"right", 1}, {"bottom", 2}, {"top", 3}, {"hole", hole}};
      if (dim == 3)
        mesh.boundary_names.insert({{"back", 4}, {"front", 5}});
      mesh.cylinders = {{hole, dealii::Point<2>()}};
    }
  } // namespace

  template <int dim>
  void generate_plate_with_hole(const MeshParameters &parameters, CoarseMesh<dim> &mesh)
  {
    const Plate plate = plate_of<dim>(parameters);
    mesh.triangulation.create_triangulation(
      vertices_of<dim>(plate), cells_of<dim>(plate), dealii::SubCellData());
    name_boundaries(plate, mesh);
  }

  PERIDEAL_INSTANTIATE(generate_plate_with_hole)
} // namespace perideal
