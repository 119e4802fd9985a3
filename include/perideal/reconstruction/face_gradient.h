// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_face_gradient_h
#define perideal_reconstruction_face_gradient_h

#include <perideal/nodes/cell_graph.h>
#include <perideal/reconstruction/boundary_point.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <vector>

namespace perideal
{
  /// Sparse rows over local nodes of the cell graph.
  template <typename Value>
  struct StencilRows
  {
    LocalIndex n_rows() const { return static_cast<LocalIndex>(first.size() - 1); }

    /// Entries of row r: [first[r], first[r+1]), columns ascending.
    std::vector<BondIndex>  first = {0};
    std::vector<LocalIndex> column;
    std::vector<Value>      value;
  };

  /**
   * Computes the gradient of a nodal field as the mean over each cell, from values at its faces:
   *
   *     G_i u = 1/V_i sum_f v_f (x) A_f,    v_f = sum_k phi_fk u_k,
   *
   * with A_f the outward area vectors and phi the moving least squares through
   * the cells that share a vertex with the face; on the boundary, the cell and
   * its vertex neighbours. One point on an edge; on a bilinear face the 2 x 2
   * Gauss points, each with its own weights. Exact for linear fields on any mesh, and because
   * the two sides of a face see one value,
   *
   *     sum_i V_i G_i^T sigma = sum_(boundary f) phi_f^T sigma A_f
   *
   * for any uniform sigma: no spurious forces, at free surfaces neither.
   *
   * Between two materials v_f is the mean of what either side extrapolates from
   * its own cells, weighted with their stiffness: exact for fields that are
   * linear in each material and continuous.
   */
  template <int dim>
  class FaceGradient
  {
  public:
    /// @param stiffness of a material, in any unit. Collective.
    FaceGradient(const Mesh<dim>                                               &mesh,
                 const Nodes<dim>                                              &nodes,
                 const std::function<double(const dealii::types::material_id)> &stiffness);

    const CellGraph<dim> &graph() const { return cells; }

    /// c_ik of G_i u = sum_k u_k (x) c_ik [1/m], by owned node.
    const StencilRows<dealii::Tensor<1, dim>> &rows() const { return gradient; }

    const std::vector<BoundaryPoint<dim>> &boundary_points() const { return points; }
    unsigned int                           n_boundary_faces() const { return n_faces; }
    /// phi at the boundary points.
    const StencilRows<double> &boundary_rows() const { return at_boundary; }

    /// Value of a field at boundary point @p p; the field by local node.
    template <typename Value>
    Value boundary_value(const unsigned int p, const std::vector<Value> &field) const
    {
      Value result = Value();
      for (BondIndex k = at_boundary.first[p]; k < at_boundary.first[p + 1]; ++k)
        result += at_boundary.value[k] * field[at_boundary.column[k]];
      return result;
    }

    /// Owned cells with a face whose cells lie in a plane (a body one cell
    /// thick): linear fields are not exact there, rotations not free of strain.
    const std::vector<bool> &deficient() const { return is_deficient; }

    std::size_t memory_consumption() const;

  private:
    class Builder;

    CellGraph<dim>                      cells;
    StencilRows<dealii::Tensor<1, dim>> gradient;
    std::vector<BoundaryPoint<dim>>     points;
    unsigned int                        n_faces = 0;
    StencilRows<double>                 at_boundary;
    std::vector<bool>                   is_deficient;
  };
} // namespace perideal

#endif
