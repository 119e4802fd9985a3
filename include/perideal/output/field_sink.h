// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_field_sink_h
#define perideal_output_field_sink_h

#include <perideal/nodes/mesh_points.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace perideal
{
  /// Takes fields of a body by their names: files do, and points at which values are recorded.
  template <int dim>
  class FieldSink
  {
  public:
    virtual ~FieldSink() = default;

    /// The points of the cells, where this takes values at them; null where it takes those of nodes alone.
    virtual MeshPoints<dim> *points() { return nullptr; }

    /// Takes a vector field that has one value at each of these points: those at the corners of the owned
    /// cells, by node. The name is of letters, digits and underscores.
    virtual void add_at_points(const std::string &, std::vector<CornerValues<dim>>) {}

    /// Takes a vector field, one value for each of this rank's nodes.
    virtual void add_vector(const std::string &name, const std::vector<dealii::Tensor<1, dim>> &values) = 0;

    /// As add_vector(), for the displacement of the nodes, of which one may know more between them.
    virtual void add_displacement(const std::string &name, const std::vector<dealii::Tensor<1, dim>> &values)
    {
      add_vector(name, values);
    }

    /// As add_vector(), for a scalar field.
    virtual void add_scalar(const std::string &name, const std::vector<double> &values) = 0;

    /// As add_vector(), for a symmetric tensor in space: scalars name_xx, name_yy,
    /// name_zz, name_xy and, in 3-D, name_yz, name_zx. (The tensors of .vtu files have no
    /// zz in 2-D, which plane strain needs.)
    void add_tensor(const std::string &name, const std::vector<dealii::SymmetricTensor<2, 3>> &values);
  };
} // namespace perideal

#endif
