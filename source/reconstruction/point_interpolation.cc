// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/mesh/point_location.h>
#include <perideal/reconstruction/linear_interpolation.h>
#include <perideal/reconstruction/point_interpolation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/mapping_q1.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <limits>
#include <sstream>

namespace perideal
{
  namespace
  {
    template <int dim>
    std::string coordinates_of(const dealii::Point<dim> &point)
    {
      std::ostringstream text;
      for (int d = 0; d < dim; ++d)
        text << (d > 0 ? ", " : "") << point[d];
      return text.str();
    }

    /// The node of all ranks that is nearest to a point. Collective.
    template <int dim>
    dealii::Point<dim> nearest_node(const CellGraph<dim> &graph, const dealii::Point<dim> &point)
    {
      dealii::Point<dim> nearest;
      double             distance = std::numeric_limits<double>::infinity();
      for (LocalIndex i = 0; i < graph.n_owned(); ++i)
        if (const double here = graph.position[i].distance(point); here < distance)
          {
            distance = here;
            nearest  = graph.position[i];
          }
      const auto of_ranks =
        dealii::Utilities::MPI::all_gather(graph.communicator, std::pair(distance, nearest));
      return std::min_element(of_ranks.begin(),
                              of_ranks.end(),
                              [](const auto &a, const auto &b) { return a.first < b.first; })
        ->second;
    }

    /// Collective, with the same distances on all ranks.
    template <int dim>
    void check_inside(const CellGraph<dim>                                            &graph,
                      const std::vector<typename PointInterpolation<dim>::NamedPoint> &points,
                      const std::vector<double>                                       &distances)
    {
      for (std::size_t p = 0; p < distances.size(); ++p)
        if (distances[p] > PointLocation<dim>::still_near)
          throw InputError("this is a point outside the body")
            .parameter(points[p].parameter)
            .given(coordinates_of(points[p].position))
            .allowed("points of the body and its boundary, up to a tenth of a cell outside")
            .hint("the nearest node is at " + coordinates_of(nearest_node(graph, points[p].position)));
    }
  } // namespace

  template <int dim>
  template <typename AddShares>
  void PointInterpolation<dim>::collect(const Mesh<dim>               &mesh,
                                        const CellGraph<dim>          &graph,
                                        const std::vector<NamedPoint> &points,
                                        const AddShares               &add_shares)
  {
    std::vector<dealii::Point<dim>> positions;
    for (const NamedPoint &point : points)
      positions.push_back(point.position);
    const dealii::MappingQ1<dim> mapping;
    std::vector<double>          distances;
    const auto places = PointLocation<dim>(mesh.triangulation, mapping).share(positions, distances);
    check_inside<dim>(graph, points, distances);

    shares_of_points.resize(points.size());
    for (std::size_t p = 0; p < points.size(); ++p)
      {
        std::vector<double> share(graph.n_local());
        for (const auto &at : places[p])
          add_shares(at.place.cell, positions[p], 1. / at.n_sharing, share);
        share = graph.sum_to_owners(share);
        for (LocalIndex i = 0; i < share.size(); ++i)
          if (share[i] != 0)
            shares_of_points[p].emplace_back(i, share[i]);
      }
  }

  template <int dim>
  PointInterpolation<dim>::PointInterpolation(const Mesh<dim>               &mesh,
                                              const CellGraph<dim>          &graph,
                                              const std::vector<NamedPoint> &points,
                                              const BondPredicate<dim>      &is_cut)
  {
    LinearInterpolation<dim> interpolation;
    collect(mesh, graph, points, [&](const auto &cell, const auto &x, const double factor, auto &share) {
      const LocalIndex                own = graph.node_of(cell);
      std::vector<LocalIndex>         stencil;
      std::vector<dealii::Point<dim>> around;
      for (const LocalIndex j : graph.cells_around(cell))
        if (graph.material[j] == graph.material[own] &&
            !(is_cut && is_cut(graph.position[own], graph.position[j])))
          {
            stencil.push_back(j);
            around.push_back(graph.position[j]);
          }
      interpolation.reinit(x, around, LinearInterpolation<dim>::Decay::at_rim, {});
      const auto &phi = interpolation.weights_at(x);
      for (std::size_t k = 0; k < stencil.size(); ++k)
        share[stencil[k]] += factor * phi[k];
    });
  }

  template <int dim>
  PointInterpolation<dim>::PointInterpolation(const Mesh<dim>               &mesh,
                                              const CellPolynomials<dim>    &polynomials,
                                              const std::vector<NamedPoint> &points)
  {
    const CellGraph<dim> &graph = polynomials.graph();
    collect(mesh, graph, points, [&](const auto &cell, const auto &x, const double factor, auto &share) {
      polynomials.visit_value(graph.node_of(cell), x, [&](const LocalIndex node, const double weight) {
        share[node] += factor * weight;
      });
    });
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> PointInterpolation<dim>::evaluate(const NodalVector &field) const
  {
    std::vector<double> sums(dim * shares_of_points.size());
    for (std::size_t p = 0; p < shares_of_points.size(); ++p)
      for (const Share &share : shares_of_points[p])
        for (int d = 0; d < dim; ++d)
          sums[dim * p + d] += share.second * field.local_element(dim * share.first + d);
    dealii::Utilities::MPI::sum(sums, field.get_mpi_communicator(), sums);

    std::vector<dealii::Tensor<1, dim>> result(shares_of_points.size());
    for (std::size_t p = 0; p < result.size(); ++p)
      for (int d = 0; d < dim; ++d)
        result[p][d] = sums[dim * p + d];
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(PointInterpolation)
} // namespace perideal
