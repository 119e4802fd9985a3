// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_recorders_point_values_h
#define perideal_recorders_point_values_h

#include <perideal/output/field_sink.h>
#include <perideal/problem/problem.h>
#include <perideal/reconstruction/point_interpolation.h>

#include <functional>
#include <string>
#include <vector>

namespace perideal
{
  /**
   * Interpolates fields at points of the body from the nodes around (PointInterpolation); the displacement of
   * the consistent form by the polynomials of its cells. Values behind precracks do not count.
   */
  template <int dim>
  class PointValues : public FieldSink<dim>
  {
  public:
    using NamedPoint = typename PointInterpolation<dim>::NamedPoint;

    /// The problem must outlive this object. Collective, with the same points on all ranks.
    /// @throws InputError naming a point outside the body.
    PointValues(const Problem<dim> &problem, const std::vector<NamedPoint> &points);

    /// A scalar, or a component of a vector, at the points.
    struct Column
    {
      std::string         name;
      std::vector<double> values;
    };

    /// Returns the columns of what was added since the last call, the same on all ranks.
    std::vector<Column> take();

    /// As FieldSink says; vectors are columns NAME_x, NAME_y, NAME_z. Collective.
    void add_vector(const std::string &name, const std::vector<dealii::Tensor<1, dim>> &values) override;
    void add_displacement(const std::string                         &name,
                          const std::vector<dealii::Tensor<1, dim>> &values) override;
    void add_scalar(const std::string &name, const std::vector<double> &values) override;

  private:
    /// @param value of an owned node
    void add_column(const PointInterpolation<dim>                 &interpolation,
                    const std::string                             &name,
                    const std::function<double(const LocalIndex)> &value);

    const Problem<dim>     &problem;
    PointInterpolation<dim> of_nodes;
    /// Of means over cells, where displacements are that.
    PointInterpolation<dim> of_polynomials;
    std::vector<Column>     columns;
  };
} // namespace perideal

#endif
