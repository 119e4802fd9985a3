// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/boundary/point_forces.h>
#include <perideal/mesh/point_location.h>
#include <perideal/quadrature/linear_interpolation.h>

#include <deal.II/fe/mapping_q1.h>

#include <algorithm>
#include <sstream>

namespace perideal
{
  namespace
  {
    template <int dim>
    void check_inside(const Loads<dim> &loads, const std::vector<double> &distances)
    {
      for (std::size_t p = 0; p < distances.size(); ++p)
        if (distances[p] > PointLocation<dim>::still_near)
          {
            std::ostringstream point;
            point << loads.point_loads[p].position;
            throw InputError("the load acts at a point outside the body")
              .parameter("Point loads/" + loads.point_loads[p].name + "/Point")
              .given(point.str())
              .allowed("points of the body and its boundary, up to a tenth of a cell outside");
          }
    }
  } // namespace

  template <int dim>
  PointForces<dim>::PointForces(const Mesh<dim> &mesh, const CellGraph<dim> &graph, const Loads<dim> &loads)
    : carriers(loads.point_loads.size())
  {
    std::vector<dealii::Point<dim>> points;
    for (const PointLoad<dim> &load : loads.point_loads)
      points.push_back(load.position);
    const dealii::MappingQ1<dim> mapping;
    std::vector<double>          distances;
    const auto places = PointLocation<dim>(mesh.triangulation, mapping).share(points, distances);
    check_inside(loads, distances);

    LinearInterpolation<dim> interpolation;
    for (std::size_t p = 0; p < points.size(); ++p)
      {
        std::vector<double> share(graph.n_local());
        for (const auto &at : places[p])
          {
            const LocalIndex                own = graph.node_of(at.place.cell);
            std::vector<LocalIndex>         stencil;
            std::vector<dealii::Point<dim>> around;
            for (const LocalIndex j : graph.cells_around(at.place.cell))
              if (graph.material[j] == graph.material[own])
                {
                  stencil.push_back(j);
                  around.push_back(graph.position[j]);
                }
            interpolation.reinit(points[p], around, LinearInterpolation<dim>::Decay::at_rim, {});
            const auto &phi = interpolation.weights_at(points[p]);
            for (std::size_t k = 0; k < stencil.size(); ++k)
              share[stencil[k]] += phi[k] / at.n_sharing;
          }
        share = graph.sum_to_owners(share);
        for (LocalIndex i = 0; i < share.size(); ++i)
          if (share[i] != 0)
            carriers[p].emplace_back(i, share[i]);
      }
  }

  template <int dim>
  void PointForces<dim>::add(const Loads<dim> &loads, const double time, NodalVector &force) const
  {
    for (std::size_t p = 0; p < carriers.size(); ++p)
      {
        const dealii::Tensor<1, dim> value = loads.point_loads[p].force_at(time);
        for (const auto &carrier : carriers[p])
          for (int d = 0; d < dim; ++d)
            force.local_element(dim * carrier.first + d) += carrier.second * value[d];
      }
  }

  template class PointForces<2>;
  template class PointForces<3>;
} // namespace perideal
