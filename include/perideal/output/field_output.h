// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_field_output_h
#define perideal_output_field_output_h

#include <perideal/mesh/mesh.h>
#include <perideal/nodes/nodes.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/vector.h>

#include <string>
#include <utility>
#include <vector>

namespace perideal
{
  /// How many sets of fields a run writes.
  enum class OutputSteps
  {
    /// One, solution.vtu; a later one takes its place.
    single,
    /// One a step, solution_0001.vtu and so on.
    series
  };

  /**
   * Writes nodal fields on the cells of the user's own mesh, for ParaView: one
   * compressed .vtu a step, with the cells of all ranks, and solution.pvd,
   * which lists the steps with their times and is valid at any moment.
   *
   * A .vtu holds single precision, for visualisation; history and
   * profiles hold all digits.
   */
  template <int dim>
  class FieldOutput
  {
  public:
    /// Collective. The mesh must live longer and stay as it is.
    /// @throws InputError when the directory cannot be written.
    FieldOutput(const Mesh<dim>   &mesh,
                const Nodes<dim>  &nodes,
                const std::string &directory,
                const OutputSteps  steps);

    /// Takes a vector field, one value for each of this rank's nodes, into the
    /// next write(). @param name letters, digits and underscores.
    void add_vector(const std::string &name, const std::vector<dealii::Tensor<1, dim>> &values);

    /// As add_vector(), for a scalar field.
    void add_scalar(const std::string &name, const std::vector<double> &values);

    /// As add_vector(), for a symmetric tensor in space: scalars name_xx, name_yy,
    /// name_zz, name_xy and, in 3-D, name_yz, name_zx. (The tensors of .vtu files have no
    /// zz in 2-D, which plane strain needs.)
    void add_tensor(const std::string &name, const std::vector<dealii::SymmetricTensor<2, 3>> &values);

    /// Goes on with a series of which an earlier run wrote the steps 1, 2, ... at these times [s].
    void resume(const std::vector<double> &times);

    /// Writes the fields added since the last write, and forgets them. Collective.
    /// @param step number in the file name @param time for the .pvd [s]
    /// @throws ComputationError when a file cannot be written.
    void write(const unsigned int step, const double time);

  private:
    using CellVector = dealii::LinearAlgebra::distributed::Vector<double>;

    std::string filename(const unsigned int step) const;
    void        write_vtu(const std::string &path, const unsigned int step, const double time) const;
    void        list_in_pvd(const std::string &name, const double time);

    const dealii::Triangulation<dim> &triangulation;
    std::vector<LocalIndex>           node_of_cell;
    std::string                       directory;
    OutputSteps                       steps;
    MPI_Comm                          communicator;

    /// dim constants a cell: what makes DataOut write true vectors.
    dealii::DoFHandler<dim> vector_unknowns;

    std::vector<std::pair<std::string, CellVector>>             vectors;
    std::vector<std::pair<std::string, dealii::Vector<double>>> scalars;
    std::vector<std::pair<double, std::string>>                 written;
  };
} // namespace perideal

#endif
