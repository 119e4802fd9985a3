// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_boundary_transfer_functions_h
#define perideal_boundary_transfer_functions_h

#include <perideal/boundary/surface_planes.h>

#include <utility>
#include <vector>

namespace perideal
{
  /**
   * The generating function of the transfer functions of PDBC between nodes and boundary faces,
   *
   *     q_ik = delta_i / (|x_i - x_k| + delta_i)   where |x_i - x_k| <= delta_i, else 0   (3.17)
   *
   * with the horizon of the node, x_k the centroid of the face, and its sums
   *
   *     Q_k = sum_i q_ik V_i,   R_i = sum_k q_ik A_k,   S = sum_k Q_k A_k
   *
   * over all nodes of cells and the whole surface, loaded, held or free. With these
   *
   *     G_ik = q_ik / Q_k                        (3.16)
   *     L_ik = lambda (q_ik S - R_i Q_k)         (3.15)
   *
   * fulfil sum_i G_ik V_i = 1, sum_i L_ik V_i = 0 and sum_k L_ik A_k = 0, (2.3) to (2.5).
   */
  template <int dim>
  class TransferFunctions
  {
  public:
    /// @param nodes those of cells
    /// @param faces the boundary faces of all ranks, as of gather_faces(). Collective.
    /// @throws InputError when a face lies in the horizon of no node.
    TransferFunctions(const NodeCloud<dim> &nodes, const std::vector<SurfaceFace<dim>> &faces);

    const std::vector<SurfaceFace<dim>> &faces() const { return surface; }

    /// An owned node whose horizon a face lies in, and q.
    using Entry = std::pair<LocalIndex, double>;
    /// The owned nodes of each face.
    const std::vector<std::vector<Entry>> &entries() const { return list; }

    /// Q_k by face [m^3], R_i by owned node [m^2], S [m^5].
    const std::vector<double> &node_sums() const { return sums_over_nodes; }
    const std::vector<double> &face_sums() const { return sums_over_faces; }
    double                     double_sum() const { return sum_over_both; }

    /// Places and volumes of the owned nodes [m], [m^3].
    const std::vector<dealii::Point<dim>> &positions() const { return position; }
    const std::vector<double>             &volumes() const { return volume; }

    MPI_Comm communicator() const { return comm; }

  private:
    std::vector<SurfaceFace<dim>>   surface;
    std::vector<std::vector<Entry>> list;
    std::vector<double>             sums_over_nodes, sums_over_faces;
    double                          sum_over_both = 0;
    std::vector<dealii::Point<dim>> position;
    std::vector<double>             volume;
    MPI_Comm                        comm;
  };
} // namespace perideal

#endif
