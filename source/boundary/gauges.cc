// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/boundary/gauges.h>

namespace perideal
{
  namespace
  {
    template <int dim>
    std::vector<typename PointInterpolation<dim>::NamedPoint> ends_of(const std::vector<Gauge<dim>> &gauges)
    {
      std::vector<typename PointInterpolation<dim>::NamedPoint> result;
      for (const Gauge<dim> &gauge : gauges)
        {
          result.push_back({"Gauges/" + gauge.name + "/From", gauge.from});
          result.push_back({"Gauges/" + gauge.name + "/To", gauge.to});
        }
      return result;
    }
  } // namespace

  template <int dim>
  Gauges<dim>::Gauges(const Mesh<dim>               &mesh,
                      const CellGraph<dim>          &graph,
                      const std::vector<Gauge<dim>> &gauges)
    : gauges(gauges)
    , ends(mesh, graph, ends_of(gauges))
  {
  }

  template <int dim>
  Gauges<dim>::Gauges(const Mesh<dim>               &mesh,
                      const CellPolynomials<dim>    &polynomials,
                      const std::vector<Gauge<dim>> &gauges)
    : gauges(gauges)
    , ends(mesh, polynomials, ends_of(gauges))
  {
  }

  template <int dim>
  std::vector<GaugeReading> Gauges<dim>::read(const NodalVector &displacement) const
  {
    return read(ends.evaluate(displacement));
  }

  template <int dim>
  std::vector<GaugeReading> Gauges<dim>::read(const std::vector<dealii::Tensor<1, dim>> &displacements) const
  {
    AssertDimension(displacements.size(), 2 * gauges.size());
    std::vector<GaugeReading> result;
    for (std::size_t k = 0; k < gauges.size(); ++k)
      {
        const dealii::Tensor<1, dim> arm      = gauges[k].to - gauges[k].from,
                                     relative = displacements[2 * k + 1] - displacements[2 * k];
        const double length = arm.norm(), now = (arm + relative).norm();
        // |a + r| - |a| without the cancellation: small strains keep their digits.
        const double elongation = (2. * (arm * relative) + relative * relative) / (now + length);
        result.push_back({1. + elongation / length, elongation});
      }
    return result;
  }

  template <int dim>
  std::vector<dealii::Point<dim>> Gauges<dim>::points() const
  {
    std::vector<dealii::Point<dim>> result;
    for (const Gauge<dim> &gauge : gauges)
      {
        result.push_back(gauge.from);
        result.push_back(gauge.to);
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(Gauges)
} // namespace perideal
