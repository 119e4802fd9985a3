// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/point_forces.h>

namespace perideal
{
  namespace
  {
    template <int dim>
    std::vector<typename PointInterpolation<dim>::NamedPoint> places_of(const Loads<dim> &loads)
    {
      std::vector<typename PointInterpolation<dim>::NamedPoint> result;
      for (const PointLoad<dim> &load : loads.point_loads)
        result.push_back({"Point loads/" + load.name + "/Point", load.position});
      return result;
    }
  } // namespace

  template <int dim>
  PointForces<dim>::PointForces(const Mesh<dim> &mesh, const CellGraph<dim> &graph, const Loads<dim> &loads)
    : carriers(mesh, graph, places_of(loads))
  {
  }

  template <int dim>
  PointForces<dim>::PointForces(const Mesh<dim>            &mesh,
                                const CellPolynomials<dim> &polynomials,
                                const Loads<dim>           &loads)
    : carriers(mesh, polynomials, places_of(loads))
  {
  }

  template <int dim>
  void PointForces<dim>::add(const Loads<dim> &loads, const double time, NodalVector &force) const
  {
    const auto &shares = carriers.shares();
    for (std::size_t p = 0; p < shares.size(); ++p)
      {
        const dealii::Tensor<1, dim> value = loads.point_loads[p].force_at(time);
        for (const auto &share : shares[p])
          for (int d = 0; d < dim; ++d)
            force.local_element(dim * share.first + d) += share.second * value[d];
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(PointForces)
} // namespace perideal
