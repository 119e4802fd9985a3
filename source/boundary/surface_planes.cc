// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/surface_planes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/boost_adaptors/bounding_box.h>
#include <deal.II/boost_adaptors/point.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  template <int dim>
  std::vector<SurfaceFace<dim>> gather_faces(const std::vector<BoundaryFace<dim>> &faces,
                                             MPI_Comm                              communicator)
  {
    constexpr std::size_t size = 2 * dim + 3 + dim * (1u << (dim - 1));
    std::vector<double>   numbers;
    for (const BoundaryFace<dim> &face : faces)
      {
        double radius = 0;
        for (const auto &vertex : face.vertices)
          radius = std::max(radius, vertex.distance(face.centre));
        numbers.push_back(face.boundary);
        for (int d = 0; d < dim; ++d)
          numbers.push_back(face.centre[d]);
        for (int d = 0; d < dim; ++d)
          numbers.push_back(face.normal[d]);
        numbers.push_back(face.area);
        numbers.push_back(radius);
        for (const auto &vertex : face.vertices)
          for (int d = 0; d < dim; ++d)
            numbers.push_back(vertex[d]);
      }
    std::vector<SurfaceFace<dim>> result;
    for (const auto &part : dealii::Utilities::MPI::all_gather(communicator, numbers))
      for (std::size_t k = 0; k < part.size(); k += size)
        {
          SurfaceFace<dim> face;
          face.boundary = static_cast<dealii::types::boundary_id>(part[k]);
          for (int d = 0; d < dim; ++d)
            {
              face.centre[d] = part[k + 1 + d];
              face.normal[d] = part[k + 1 + dim + d];
            }
          face.area   = part[k + 1 + 2 * dim];
          face.radius = part[k + 2 + 2 * dim];
          for (std::size_t v = 0; v < face.vertices.size(); ++v)
            for (int d = 0; d < dim; ++d)
              face.vertices[v][d] = part[k + 3 + 2 * dim + dim * v + d];
          result.push_back(face);
        }
    return result;
  }

  template <int dim>
  void visit_nearby_faces(
    const NodeCloud<dim>                                                                       &nodes,
    const std::vector<SurfaceFace<dim>>                                                        &faces,
    const std::function<void(const LocalIndex, const std::vector<const SurfaceFace<dim> *> &)> &visit,
    const double                                                                                horizons)
  {
    std::vector<dealii::Point<dim>> centres;
    double                          largest = 0;
    for (const auto &face : faces)
      {
        centres.push_back(face.centre);
        largest = std::max(largest, face.radius);
      }
    const auto                            tree = dealii::pack_rtree_of_indices(centres);
    std::vector<std::size_t>              found;
    std::vector<const SurfaceFace<dim> *> near;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        const auto            &x     = nodes.position[i];
        const double           reach = horizons * nodes.horizon[i] + largest;
        dealii::Tensor<1, dim> step;
        for (int d = 0; d < dim; ++d)
          step[d] = reach;
        const dealii::BoundingBox<dim> box({x - step, x + step});
        found.clear();
        tree.query(boost::geometry::index::intersects(box), std::back_inserter(found));
        near.clear();
        for (const std::size_t k : found)
          if (x.distance(faces[k].centre) <= horizons * nodes.horizon[i] + faces[k].radius)
            near.push_back(&faces[k]);
        // Faces at one distance in the order of their places, whatever rank they come from.
        std::sort(near.begin(), near.end(), [&](const auto *a, const auto *b) {
          const double difference = x.distance(a->centre) - x.distance(b->centre);
          if (std::abs(difference) > 1e-9 * reach)
            return difference < 0;
          for (int d = 0; d < dim; ++d)
            if (a->centre[d] != b->centre[d])
              return a->centre[d] < b->centre[d];
          return false;
        });
        visit(i, near);
      }
  }

  template <int dim>
  std::vector<std::vector<SurfacePlane<dim>>> find_surface_planes(const NodeCloud<dim>                &nodes,
                                                                  const std::vector<SurfaceFace<dim>> &faces)
  {
    const double                                unlike = std::cos(dealii::numbers::PI / 6);
    std::vector<std::vector<SurfacePlane<dim>>> result(nodes.size());
    visit_nearby_faces<dim>(
      nodes, faces, [&](const LocalIndex i, const std::vector<const SurfaceFace<dim> *> &near) {
        for (const auto *face : near)
          {
            const double depth = (face->centre - nodes.position[i]) * face->normal;
            if (depth > nodes.horizon[i] ||
                std::any_of(result[i].begin(), result[i].end(), [&](const SurfacePlane<dim> &plane) {
                  return plane.normal * face->normal > unlike;
                }))
              continue;
            result[i].push_back({face->boundary, face->centre, face->normal, std::max(depth, 0.)});
          }
      });
    return result;
  }

  PERIDEAL_INSTANTIATE(gather_faces)
  PERIDEAL_INSTANTIATE(visit_nearby_faces)
  PERIDEAL_INSTANTIATE(find_surface_planes)

} // namespace perideal
