// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/output/boundary_curve.h>
#include <perideal/output/gather.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_nothing.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace perideal
{
  template <int dim>
  BoundaryCurve<dim>::BoundaryCurve(const Mesh<dim> &mesh, const dealii::types::boundary_id boundary)
    : communicator(mesh.triangulation.get_communicator())
  {
    measure(mesh, boundary);
  }

  template <int dim>
  void BoundaryCurve<dim>::measure(const Mesh<dim> &mesh, const dealii::types::boundary_id boundary)
  {
    const dealii::MappingQ1<dim>  mapping;
    const dealii::FE_Nothing<dim> no_element;
    const dealii::QGauss<dim - 1> quadrature(2);
    dealii::FEFaceValues<dim>     values(mapping,
                                     no_element,
                                     quadrature,
                                     dealii::update_JxW_values | dealii::update_normal_vectors |
                                       dealii::update_quadrature_points);

    // Area, its part that looks sideways (normal in the x-y plane), the sum of
    // the normals there, and the moment of the area.
    std::vector<double> sums(4 + dim, 0.);
    // Smallest coordinates, and the largest ones with their sign turned.
    std::vector<double> minima(2 * dim, std::numeric_limits<double>::max());
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == boundary)
            {
              values.reinit(cell, f);
              for (const unsigned int q : values.quadrature_point_indices())
                {
                  const auto  &normal = values.normal_vector(q);
                  const double area   = values.JxW(q);
                  sums[0] += area;
                  sums[1] += area * std::hypot(normal[0], normal[1]);
                  sums[2] += area * normal[0];
                  sums[3] += area * normal[1];
                  for (unsigned int d = 0; d < dim; ++d)
                    sums[4 + d] += area * values.quadrature_point(q)[d];
                }
              for (const unsigned int v : cell->face(f)->vertex_indices())
                for (unsigned int d = 0; d < dim; ++d)
                  {
                    minima[d]       = std::min(minima[d], cell->face(f)->vertex(v)[d]);
                    minima[dim + d] = std::min(minima[dim + d], -cell->face(f)->vertex(v)[d]);
                  }
            }
    dealii::Utilities::MPI::sum(sums, communicator, sums);
    dealii::Utilities::MPI::min(minima, communicator, minima);

    // Hanging nodes on a curved surface leave small gaps, hence a tolerance far
    // above round-off. A face across z has no sideways part and is open.
    closed = sums[1] > 1e-2 * sums[0] && std::hypot(sums[2], sums[3]) < 1e-2 * sums[1];

    double longest = 0;
    for (unsigned int d = 0; d < dim; ++d)
      {
        centre[d]    = sums[4 + d] / sums[0];
        lower_end[d] = minima[d];
        // The first of equally long sides, whatever round-off says.
        if (-minima[dim + d] - minima[d] > longest * (1 + 1e-9))
          {
            longest           = -minima[dim + d] - minima[d];
            longest_direction = d;
          }
      }
  }

  template <int dim>
  double BoundaryCurve<dim>::coordinate(const dealii::Point<dim> &point) const
  {
    if (!closed)
      return point[longest_direction] - lower_end[longest_direction];
    const double angle = std::atan2(point[1] - centre[1], point[0] - centre[0]) * 180 / dealii::numbers::PI;
    // Round-off must not send a node on the x axis to the end of the profile.
    if (std::abs(angle) < 1e-9)
      return 0;
    return angle < 0 ? angle + 360 : angle;
  }

  template <int dim>
  std::vector<std::size_t> BoundaryCurve<dim>::sort(const std::vector<dealii::Point<dim>> &points) const
  {
    // Points above one another have equal coordinates but for round-off, which
    // the centre of the boundary takes from the number of ranks: compare
    // rounded values, first the coordinate, then z, y, x.
    const double                             resolution = closed ? 1e-6 : 1e-9 * lower_end.distance(centre);
    std::vector<std::array<double, dim + 1>> keys;
    for (const auto &point : points)
      {
        std::array<double, dim + 1> key;
        key[0] = std::round(coordinate(point) / resolution);
        for (unsigned int d = 0; d < dim; ++d)
          key[1 + d] = point[dim - 1 - d];
        keys.push_back(key);
      }
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](const auto a, const auto b) { return keys[a] < keys[b]; });
    return order;
  }

  template <int dim>
  std::vector<std::string> BoundaryCurve<dim>::header() const
  {
    std::vector<std::string> result = {closed ? "angle [deg]" : "s [m]", "x [m]", "y [m]"};
    if (dim == 3)
      result.push_back("z [m]");
    return result;
  }

  template <int dim>
  std::vector<std::vector<double>>
  BoundaryCurve<dim>::rows(const std::vector<dealii::Point<dim>>  &points,
                           const std::vector<std::vector<double>> &values) const
  {
    AssertDimension(points.size(), values.size());
    const auto                       all_points = gather(points, communicator);
    const auto                       all_values = gather(values, communicator);
    std::vector<std::vector<double>> result;
    for (const std::size_t i : sort(all_points))
      {
        result.push_back({coordinate(all_points[i])});
        for (unsigned int d = 0; d < dim; ++d)
          result.back().push_back(all_points[i][d]);
        result.back().insert(result.back().end(), all_values[i].begin(), all_values[i].end());
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(BoundaryCurve)
} // namespace perideal
