// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_boundary_curve_h
#define perideal_output_boundary_curve_h

#include <perideal/mesh/mesh.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace perideal
{
  /**
   * Sorts points along a boundary, for plots of fields over it. The order does not
   * depend on the number of ranks.
   *
   * A boundary whose outward normals cancel in the x-y plane (a hole, a whole
   * contour, two opposite edges) goes round its centre, and points on it are
   * sorted by the angle about it, from the x axis over the y axis, in 3-D then
   * by z. Any other (an edge, an arc) is open, and points are sorted along
   * the longest side of the box that holds the boundary.
   */
  template <int dim>
  class BoundaryCurve
  {
  public:
    /// Collective.
    BoundaryCurve(const Mesh<dim> &mesh, const dealii::types::boundary_id boundary);

    /// Whether the boundary goes round its centre.
    bool is_closed() const { return closed; }

    /// Angle [deg], 0 to 360, or distance [m] from the lower end of the boundary.
    double coordinate(const dealii::Point<dim> &point) const;

    /// Names of the columns that rows() begins with: "angle [deg]" or "s [m]", x, y, z [m].
    std::vector<std::string> header() const;

    /**
     * The rows of all ranks in the order of the boundary, on rank 0, empty on
     * others: coordinate, x, y, z of a point, then what @p values has for it.
     * Collective.
     */
    std::vector<std::vector<double>> rows(const std::vector<dealii::Point<dim>>  &points,
                                          const std::vector<std::vector<double>> &values) const;

  private:
    /// Shape of the boundary, from integrals over its faces on all ranks.
    void measure(const Mesh<dim> &mesh, const dealii::types::boundary_id boundary);
    /// Numbers of the points in the order of the boundary.
    std::vector<std::size_t> sort(const std::vector<dealii::Point<dim>> &points) const;

    MPI_Comm           communicator;
    bool               closed = false;
    dealii::Point<dim> centre;
    dealii::Point<dim> lower_end;
    unsigned int       longest_direction = 0;
  };
} // namespace perideal

#endif
