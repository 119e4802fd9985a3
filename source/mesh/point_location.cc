// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/mesh/point_location.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <limits>

namespace perideal
{
  namespace bgi = boost::geometry::index;

  template <int dim>
  PointLocation<dim>::PointLocation(const dealii::Triangulation<dim> &triangulation,
                                    const dealii::Mapping<dim>       &mapping)
    : mapping(mapping)
    , grid(triangulation, mapping)
  {
  }

  template <int dim>
  void PointLocation<dim>::visit(const dealii::Point<dim>                 &point,
                                 const Candidates                          candidates,
                                 const std::function<bool(const Place &)> &visit) const
  {
    using Cell       = typename dealii::Triangulation<dim>::active_cell_iterator;
    const auto &tree = grid.get_locally_owned_cell_bounding_boxes_rtree();
    std::vector<std::pair<dealii::BoundingBox<dim>, Cell>> found;
    if (candidates == Candidates::around_point)
      tree.query(bgi::intersects(point), std::back_inserter(found));
    else
      tree.query(bgi::nearest(point, 4 * dealii::GeometryInfo<dim>::vertices_per_cell),
                 std::back_inserter(found));
    for (const auto &candidate : found)
      {
        Place place;
        place.cell = candidate.second;
        mapping.transform_points_real_to_unit_cell(
          place.cell,
          dealii::ArrayView<const dealii::Point<dim>>(&point, 1),
          dealii::ArrayView<dealii::Point<dim>>(&place.unit_point, 1));
        place.distance = dealii::GeometryInfo<dim>::distance_to_unit_cell(place.unit_point);
        if (!visit(place))
          break;
      }
  }

  template <int dim>
  std::vector<std::vector<typename PointLocation<dim>::SharedPlace>>
  PointLocation<dim>::share(const std::vector<dealii::Point<dim>> &points,
                            std::vector<double>                   &distances) const
  {
    const MPI_Comm                        communicator = grid.get_triangulation().get_communicator();
    std::vector<std::vector<SharedPlace>> result(points.size());
    distances.assign(points.size(), std::numeric_limits<double>::max());
    for (std::size_t p = 0; p < points.size(); ++p)
      visit(points[p], Candidates::nearest, [&](const Place &place) {
        result[p].push_back({place, 0});
        distances[p] = std::min(distances[p], place.distance);
        return true;
      });
    dealii::Utilities::MPI::min(distances, communicator, distances);

    std::vector<unsigned int> n_sharing(points.size());
    for (std::size_t p = 0; p < points.size(); ++p)
      {
        auto &places = result[p];
        places.erase(std::remove_if(places.begin(),
                                    places.end(),
                                    [&](const SharedPlace &shared) {
                                      return shared.place.distance > distances[p] + inside;
                                    }),
                     places.end());
        n_sharing[p] = places.size();
      }
    dealii::Utilities::MPI::sum(n_sharing, communicator, n_sharing);
    for (std::size_t p = 0; p < points.size(); ++p)
      for (SharedPlace &shared : result[p])
        shared.n_sharing = n_sharing[p];
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(PointLocation)
} // namespace perideal
