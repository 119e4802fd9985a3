// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_gauges_h
#define perideal_boundary_gauges_h

#include <perideal/parameters/gauge_parameters.h>
#include <perideal/reconstruction/point_interpolation.h>

#include <vector>

namespace perideal
{
  /// What a gauge shows.
  struct GaugeReading
  {
    /// Distance of the points in the deformed body over that in the undeformed one [-].
    double stretch;
    /// Their difference [m].
    double elongation;
  };

  /**
   * Extensometers, which follow two points of the body wherever they go: rigid-body motions, rotations
   * included, change nothing. The displacement at a point is that of PointInterpolation.
   */
  template <int dim>
  class Gauges
  {
  public:
    /// Collective.
    /// @throws InputError naming a point outside the body.
    Gauges(const Mesh<dim> &mesh, const CellGraph<dim> &graph, const std::vector<Gauge<dim>> &gauges);

    /// The same in a body whose displacement is means over cells.
    Gauges(const Mesh<dim>               &mesh,
           const CellPolynomials<dim>    &polynomials,
           const std::vector<Gauge<dim>> &gauges);

    /// Of a displacement of the nodes or of means [m], by gauge. Collective.
    std::vector<GaugeReading> read(const NodalVector &displacement) const;

    /// Of the displacements [m] of points().
    std::vector<GaugeReading> read(const std::vector<dealii::Tensor<1, dim>> &displacements) const;

    /// The beginning and the end of each gauge, one after the other [m].
    std::vector<dealii::Point<dim>> points() const;

    const std::vector<Gauge<dim>> &list() const { return gauges; }

  private:
    std::vector<Gauge<dim>> gauges;
    PointInterpolation<dim> ends;
  };
} // namespace perideal

#endif
