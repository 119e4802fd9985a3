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
  /// Writes the values of some nodes in a given order, for plots of fields over it.
  template <int dim>
  class Profile
  {
  public:
    /// A name and the values of this rank's nodes.
    using NamedField = std::pair<std::string, std::vector<dealii::Tensor<1, dim>>>;

    virtual ~Profile() = default;

    /// This rank's nodes of the profile.
    const std::vector<LocalIndex> &local_nodes() const { return selected; }

    /// Writes a CSV file: the columns of header(), then NAME_u_x,
    /// NAME_u_y, ... of each field. A profile without nodes leaves the header only. Collective.
    /// @throws ComputationError when the file cannot be written.
    void write(const std::string &path, const std::vector<NamedField> &fields) const;

  protected:
    Profile(const Nodes<dim> &nodes, const std::vector<LocalIndex> &selected);

    /// Names of the columns that rows() begins with.
    virtual std::vector<std::string> header() const = 0;

    /// The rows of all ranks in order, on rank 0: a coordinate, x, y, z, and the values of the node.
    /// Collective.
    virtual std::vector<std::vector<double>> rows(const std::vector<std::vector<double>> &values) const = 0;

    MPI_Comm                        communicator;
    std::vector<LocalIndex>         selected;
    std::vector<dealii::Point<dim>> points;
  };

  /// Writes the nodes along a boundary in the order of its curve: those whose cells have a face on it.
  template <int dim>
  class BoundaryProfile : public Profile<dim>
  {
  public:
    /// Collective.
    BoundaryProfile(const Mesh<dim>                 &mesh,
                    const Nodes<dim>                &nodes,
                    const dealii::types::boundary_id boundary);

    /// Whether the boundary goes round its centre.
    bool is_closed() const { return curve.is_closed(); }

  private:
    std::vector<std::string>         header() const override { return curve.header(); }
    std::vector<std::vector<double>> rows(const std::vector<std::vector<double>> &values) const override
    {
      return curve.rows(this->points, values);
    }

    BoundaryCurve<dim> curve;
  };

  /// Writes the nodes along a straight line through the body: those whose cells it passes through, by their
  /// distance from its beginning along it.
  template <int dim>
  class LineProfile : public Profile<dim>
  {
  public:
    LineProfile(const Mesh<dim>          &mesh,
                const Nodes<dim>         &nodes,
                const dealii::Point<dim> &from,
                const dealii::Point<dim> &to);

  private:
    std::vector<std::string>         header() const override;
    std::vector<std::vector<double>> rows(const std::vector<std::vector<double>> &values) const override;

    dealii::Point<dim> from, to;
  };
} // namespace perideal

#endif
