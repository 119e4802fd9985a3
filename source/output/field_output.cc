// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/output/field_output.h>
#include <perideal/output/files.h>
#include <perideal/output/paraview_state.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace perideal
{
  namespace
  {
    /// Numbers that one message takes.
    constexpr std::size_t at_once = 1 << 27;

    /// Puts the values of all ranks behind those of the first one, in their order. Collective.
    template <typename T>
    void append_other_ranks(std::vector<T> &values, MPI_Comm communicator)
    {
      const auto type = dealii::Utilities::MPI::mpi_type_id_for_type<T>;
      const auto sizes =
        dealii::Utilities::MPI::all_gather(communicator, static_cast<std::uint64_t>(values.size()));
      const auto part = [&](const std::size_t n, const std::size_t k) { return std::min(at_once, n - k); };
      if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
        {
          for (std::size_t k = 0; k < values.size(); k += at_once)
            MPI_Send(values.data() + k, part(values.size(), k), type, 0, 0, communicator);
          return;
        }
      for (unsigned int rank = 1; rank < sizes.size(); ++rank)
        {
          const std::size_t before = values.size();
          values.resize(before + sizes[rank]);
          for (std::size_t k = 0; k < sizes[rank]; k += at_once)
            MPI_Recv(values.data() + before + k,
                     part(sizes[rank], k),
                     type,
                     rank,
                     0,
                     communicator,
                     MPI_STATUS_IGNORE);
        }
    }
  } // namespace

  template <int dim>
  FieldOutput<dim>::FieldOutput(const Mesh<dim>                 &mesh,
                                const Nodes<dim>                &nodes,
                                std::unique_ptr<MeshPoints<dim>> points,
                                const std::string               &directory,
                                const OutputSteps                steps,
                                const OutputFormat               format)
    : mesh_points(std::move(points))
    , directory(directory)
    , steps(steps)
    , format(format)
    , communicator(nodes.communicator)
  {
    create_output_directory(directory, communicator);
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        node_of_cell.push_back(nodes.node_of_cell[cell->active_cell_index()]);
  }

  template <int dim>
  void FieldOutput<dim>::add_at_points(const std::string &name, std::vector<CornerValues<dim>> values)
  {
    AssertDimension(values.size(), node_of_cell.size());
    at_points.emplace_back(name, std::move(values));
  }

  template <int dim>
  void FieldOutput<dim>::add_vector(const std::string                         &name,
                                    const std::vector<dealii::Tensor<1, dim>> &values)
  {
    VtuArray array{name, 3, {}};
    for (const LocalIndex node : node_of_cell)
      {
        AssertIndexRange(node, values.size());
        for (unsigned int d = 0; d < 3; ++d)
          array.values.push_back(d < dim ? values[node][d] : 0.);
      }
    of_cells.push_back(std::move(array));
  }

  template <int dim>
  void FieldOutput<dim>::add_scalar(const std::string &name, const std::vector<double> &values)
  {
    VtuArray array{name, 1, {}};
    for (const LocalIndex node : node_of_cell)
      {
        AssertIndexRange(node, values.size());
        array.values.push_back(values[node]);
      }
    of_cells.push_back(std::move(array));
  }

  template <int dim>
  void FieldOutput<dim>::resume(const std::vector<double> &times)
  {
    for (std::size_t k = 0; k < times.size(); ++k)
      written.emplace_back(times[k], filename(k + 1));
  }

  template <int dim>
  void FieldOutput<dim>::write(const unsigned int step, const double time)
  {
    VtuPiece piece = format == OutputFormat::vtu ? whole_body() : own_cells();
    piece.step     = step;
    piece.time     = time;
    if (format == OutputFormat::vtu)
      write_vtu(piece, directory + "/" + filename(step));
    else
      write_pvtu(piece, stem(step));
    list_in_pvd(filename(step), time);
    write_state(piece);
    at_points.clear();
    of_cells.clear();
  }

  template <int dim>
  std::string FieldOutput<dim>::stem(const unsigned int step) const
  {
    return steps == OutputSteps::single ? "solution" :
                                          "solution_" + dealii::Utilities::int_to_string(step, 4);
  }

  template <int dim>
  std::string FieldOutput<dim>::filename(const unsigned int step) const
  {
    return stem(step) + "." + name_of(format);
  }

  template <int dim>
  void FieldOutput<dim>::set_points(const std::vector<Corner> &corners, VtuPiece &piece) const
  {
    const auto add = [](const dealii::Tensor<1, dim> &value, std::vector<float> &values) {
      for (unsigned int d = 0; d < 3; ++d)
        values.push_back(d < dim ? value[d] : 0.);
    };
    piece.dimension = dim;
    piece.cell_data = of_cells;
    for (const Corner &at : corners)
      add(mesh_points->cell(at.node)->vertex(at.corner), piece.points);
    for (const auto &[name, values] : at_points)
      {
        piece.point_data.push_back({name, 3, {}});
        for (const Corner &at : corners)
          add(values[at.node][at.corner], piece.point_data.back().values);
      }
  }

  template <int dim>
  VtuPiece FieldOutput<dim>::whole_body() const
  {
    VtuPiece piece;
    set_points(mesh_points->own_points(), piece);
    for (const LocalIndex node : node_of_cell)
      for (const GlobalIndex point : mesh_points->numbers()[node])
        piece.corners.push_back(point);
    append_other_ranks(piece.points, communicator);
    append_other_ranks(piece.corners, communicator);
    for (auto *arrays : {&piece.point_data, &piece.cell_data})
      for (VtuArray &array : *arrays)
        append_other_ranks(array.values, communicator);
    return piece;
  }

  template <int dim>
  VtuPiece FieldOutput<dim>::own_cells() const
  {
    VtuPiece                            piece;
    std::vector<Corner>                 corners;
    std::map<GlobalIndex, std::int64_t> place;
    for (const LocalIndex node : node_of_cell)
      for (unsigned int v = 0; v < MeshPoints<dim>::n_corners; ++v)
        {
          const auto found = place.insert({mesh_points->numbers()[node][v], corners.size()});
          if (found.second)
            corners.push_back({node, v});
          piece.corners.push_back(found.first->second);
        }
    set_points(corners, piece);
    return piece;
  }

  template <int dim>
  void FieldOutput<dim>::write_vtu(VtuPiece &piece, const std::string &path) const
  {
    write_together(communicator, [&] {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        replace_file(path, vtu_text(piece));
    });
  }

  template <int dim>
  void FieldOutput<dim>::write_pvtu(VtuPiece &piece, const std::string &stem) const
  {
    const auto file_of = [&](const unsigned int rank) {
      return stem + "_" + dealii::Utilities::int_to_string(rank, 4) + ".vtu";
    };
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    std::string        problem;
    try
      {
        replace_file(directory + "/" + file_of(rank), vtu_text(piece));
      }
    catch (const ComputationError &error)
      {
        problem = error.what();
      }
    for (const std::string &of_rank : dealii::Utilities::MPI::all_gather(communicator, problem))
      if (!of_rank.empty())
        throw ComputationError(of_rank);
    write_together(communicator, [&] {
      if (rank != 0)
        return;
      std::vector<std::string> files;
      for (unsigned int other = 0; other < dealii::Utilities::MPI::n_mpi_processes(communicator); ++other)
        files.push_back(file_of(other));
      replace_file(directory + "/" + stem + ".pvtu", pvtu_text(piece, files));
    });
  }

  template <int dim>
  void FieldOutput<dim>::list_in_pvd(const std::string &name, const double time)
  {
    if (steps == OutputSteps::single)
      written.clear();
    written.emplace_back(time, name);
    write_together(communicator, [&] {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
        return;
      std::ostringstream record;
      record.precision(12);
      dealii::DataOutBase::write_pvd_record(record, written);
      replace_file(directory + "/solution.pvd", record.str());
    });
  }

  template <int dim>
  void FieldOutput<dim>::write_state(const VtuPiece &part) const
  {
    const std::string text = state_text(choose_state(part, communicator));
    write_together(communicator, [&] {
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        replace_file(directory + "/solution.pvsm", text);
    });
  }

  PERIDEAL_INSTANTIATE_CLASS(FieldOutput)
} // namespace perideal
