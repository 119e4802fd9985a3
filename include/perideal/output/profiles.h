// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_profiles_h
#define perideal_output_profiles_h

#include <perideal/nodes/nodes.h>
#include <perideal/output/boundary_curve.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /// The nodes along a boundary in the order of its curve, for plots of fields over it.
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
    bool is_closed() const { return curve.is_closed(); }

    /// This rank's nodes whose cells have a face on the boundary.
    const std::vector<LocalIndex> &local_nodes() const { return selected; }

    /// Writes a CSV file: the columns of BoundaryCurve::rows(), then NAME_u_x,
    /// NAME_u_y, ... of each field. A boundary without nodes leaves the header only. Collective.
    /// @throws ComputationError when the file cannot be written.
    void write(const std::string &path, const std::vector<NamedField> &fields) const;

  private:
    MPI_Comm                        communicator;
    BoundaryCurve<dim>              curve;
    std::vector<LocalIndex>         selected;
    std::vector<dealii::Point<dim>> points;
  };
} // namespace perideal

#endif
