// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_output_field_output_h
#define perideal_output_field_output_h

#include <perideal/mesh/mesh.h>
#include <perideal/output/field_sink.h>
#include <perideal/output/output_format.h>
#include <perideal/output/vtu_text.h>

#include <memory>
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
   * Writes fields on the user's own mesh, for ParaView: a compressed .vtu a step, and solution.pvd, which
   * lists the steps with their times and is valid at any moment; solution.pvsm, ParaView's state, shows them.
   * Fields of nodes are data of cells. Cells share the points at which they meet, so that fields at points
   * are continuous but for cracks, and a part that is warped by them has no gaps.
   *
   * A .vtu holds single precision, for visualisation; history and
   * profiles hold all digits.
   */
  template <int dim>
  class FieldOutput : public FieldSink<dim>
  {
  public:
    /// Collective. The mesh must live longer and stay as it is.
    /// @param points of the cells
    /// @throws InputError when the directory cannot be written.
    FieldOutput(const Mesh<dim>                 &mesh,
                const Nodes<dim>                &nodes,
                std::unique_ptr<MeshPoints<dim>> points,
                const std::string               &directory,
                const OutputSteps                steps,
                const OutputFormat               format = OutputFormat::vtu);

    /// The points of the cells, which may open between two writes.
    MeshPoints<dim> *points() override { return mesh_points.get(); }

    /// As FieldSink says, into the next write().
    void add_at_points(const std::string &name, std::vector<CornerValues<dim>> values) override;
    void add_vector(const std::string &name, const std::vector<dealii::Tensor<1, dim>> &values) override;
    void add_scalar(const std::string &name, const std::vector<double> &values) override;

    /// Goes on with a series of which an earlier run wrote the steps 1, 2, ... at these times [s].
    void resume(const std::vector<double> &times);

    /// Writes the fields added since the last write, and forgets them. Collective.
    /// @param step number in the file name @param time for the .pvd [s]
    /// @throws ComputationError when a file cannot be written.
    void write(const unsigned int step, const double time);

  private:
    using PointField = std::pair<std::string, std::vector<CornerValues<dim>>>;
    using Corner     = typename MeshPoints<dim>::Corner;

    /// Name of the files of a step, without the end.
    std::string stem(const unsigned int step) const;
    std::string filename(const unsigned int step) const;
    /// Sets coordinates and fields of some points, each by a corner at it.
    void set_points(const std::vector<Corner> &corners, VtuPiece &piece) const;
    /// The cells of all ranks, on rank 0. Collective.
    VtuPiece whole_body() const;
    /// The cells of this rank.
    VtuPiece own_cells() const;
    void     write_vtu(VtuPiece &piece, const std::string &path) const;
    void     write_pvtu(VtuPiece &piece, const std::string &stem) const;
    void     list_in_pvd(const std::string &name, const double time);
    /// Writes the state with which ParaView shows this step and all before it. Collective.
    void write_state(const VtuPiece &part) const;

    /// Nodes of the owned cells, in the order of the cells.
    std::vector<LocalIndex>          node_of_cell;
    std::unique_ptr<MeshPoints<dim>> mesh_points;
    std::string                      directory;
    OutputSteps                      steps;
    OutputFormat                     format;
    MPI_Comm                         communicator;

    std::vector<PointField>                     at_points;
    std::vector<VtuArray>                       of_cells;
    std::vector<std::pair<double, std::string>> written;
  };
} // namespace perideal

#endif
