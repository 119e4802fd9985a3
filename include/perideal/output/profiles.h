// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_profiles_h
#define perideal_output_profiles_h

#include <perideal/mesh/mesh.h>
#include <perideal/nodes/nodes.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * The nodes along a boundary in their natural order, for plots of fields
   * over it. The order does not depend on the number of ranks.
   *
   * A boundary whose outward normals cancel in the x-y plane (a hole, a whole
   * contour, two opposite edges) goes round its centre, and its nodes are
   * sorted by the angle about it, from the x axis over the y axis, in 3-D then
   * by z. Any other (an edge, an arc) is open, and its nodes are sorted along
   * the longest side of the box that holds the boundary.
   */
  template <int dim>
  class BoundaryProfile
  {
  public:
    /// A name and the values of this rank's nodes.
    using NamedField = std::pair<std::string, std::vector<dealii::Tensor<1, dim>>>;

    /// Collective.
    BoundaryProfile(const Mesh<dim>                 &mesh,
                    const Nodes<dim>                &nodes,
                    const dealii::types::boundary_id boundary);

    /// Whether the boundary goes round its centre.
    bool is_closed() const { return closed; }

    /// This rank's nodes whose cells have a face on the boundary.
    const std::vector<LocalIndex> &local_nodes() const { return selected; }

    /// Writes a CSV file: "angle [deg]" (0 to 360) or "s [m]" (from the lower
    /// end of the boundary), x, y, z [m], then NAME_u_x, NAME_u_y, ... of each
    /// field. A boundary without nodes leaves the header only. Collective.
    /// @throws ComputationError when the file cannot be written.
    void write(const std::string &path, const std::vector<NamedField> &fields) const;

  private:
    /// Shape of the boundary, from integrals over its faces on all ranks.
    void measure_boundary(const Mesh<dim> &mesh, const dealii::types::boundary_id boundary);
    /// Angle [deg] or distance [m].
    double coordinate(const dealii::Point<dim> &point) const;
    /// Fills points and order on rank 0.
    void sort(const Nodes<dim> &nodes);

    MPI_Comm                communicator;
    std::vector<LocalIndex> selected;

    bool               closed = false;
    dealii::Point<dim> centre;
    dealii::Point<dim> lower_end;
    unsigned int       longest_direction = 0;

    /// Of all ranks, one rank after the other; on rank 0 only.
    std::vector<dealii::Point<dim>> points;
    /// Numbers of the points in the order of the profile; on rank 0 only.
    std::vector<std::size_t> order;
  };
} // namespace perideal

#endif
