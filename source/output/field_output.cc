// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/base/instantiate.h>
#include <perideal/base/links.h>
#include <perideal/output/field_output.h>
#include <perideal/output/files.h>
#include <perideal/output/tensor_components.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace perideal
{
  namespace
  {
    /// What DataOut would write.
    template <int dim>
    struct OpenDataOut : public dealii::DataOut<dim>
    {
      using dealii::DataOut<dim>::get_dataset_names;
      using dealii::DataOut<dim>::get_nonscalar_data_ranges;
      using dealii::DataOut<dim>::get_patches;
    };

    /// Letters that one message takes.
    constexpr std::size_t at_once = 1 << 28;

    /// Writes the texts of all ranks, in their order, through the first one, to a file beside the path that
    /// then takes its place. (MPI's own files print lines of their own where a disk is full, and tell no
    /// error.) Collective. @throws ComputationError on all ranks.
    void write_texts(const std::string &path, const std::string &text, MPI_Comm communicator)
    {
      using namespace dealii::Utilities::MPI;
      const auto        sizes      = all_gather(communicator, static_cast<std::uint64_t>(text.size()));
      const std::string part       = path + ".part";
      bool              is_written = true;
      if (this_mpi_process(communicator) != 0)
        for (std::size_t k = 0; k < text.size(); k += at_once)
          MPI_Send(text.data() + k, std::min(at_once, text.size() - k), MPI_CHAR, 0, 0, communicator);
      else
        {
          remove_link(part);
          std::ofstream file(part, std::ios::binary);
          file << text;
          std::vector<char> received;
          for (unsigned int rank = 1; rank < sizes.size(); ++rank)
            for (std::size_t k = 0; k < sizes[rank]; k += at_once)
              {
                received.resize(std::min<std::size_t>(at_once, sizes[rank] - k));
                MPI_Recv(
                  received.data(), received.size(), MPI_CHAR, rank, 0, communicator, MPI_STATUS_IGNORE);
                file.write(received.data(), received.size());
              }
          file.close();
          is_written = file.good();
        }
      write_together(communicator, [&] {
        if (this_mpi_process(communicator) == 0)
          finish_file(is_written, part, path);
      });
    }
  } // namespace

  template <int dim>
  FieldOutput<dim>::FieldOutput(const Mesh<dim>   &mesh,
                                const Nodes<dim>  &nodes,
                                const std::string &directory,
                                const OutputSteps  steps)
    : triangulation(mesh.triangulation)
    , node_of_cell(nodes.node_of_cell)
    , directory(directory)
    , steps(steps)
    , communicator(nodes.communicator)
    , vector_unknowns(mesh.triangulation)
  {
    create_output_directory(directory, communicator);
    vector_unknowns.distribute_dofs(dealii::FESystem<dim>(dealii::FE_DGQ<dim>(0), dim));
  }

  template <int dim>
  void FieldOutput<dim>::add_vector(const std::string                         &name,
                                    const std::vector<dealii::Tensor<1, dim>> &values)
  {
    CellVector cell_values(vector_unknowns.locally_owned_dofs(), communicator);

    std::vector<dealii::types::global_dof_index> unknowns(dim);
    for (const auto &cell : vector_unknowns.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const LocalIndex node = node_of_cell[cell->active_cell_index()];
          AssertIndexRange(node, values.size());
          cell->get_dof_indices(unknowns);
          for (unsigned int d = 0; d < dim; ++d)
            cell_values(unknowns[d]) = values[node][d];
        }
    vectors.emplace_back(name, std::move(cell_values));
  }

  template <int dim>
  void FieldOutput<dim>::add_scalar(const std::string &name, const std::vector<double> &values)
  {
    dealii::Vector<double> cell_values(triangulation.n_active_cells());
    for (const auto &cell : triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const LocalIndex node = node_of_cell[cell->active_cell_index()];
          AssertIndexRange(node, values.size());
          cell_values[cell->active_cell_index()] = values[node];
        }
    scalars.emplace_back(name, std::move(cell_values));
  }

  template <int dim>
  void FieldOutput<dim>::add_tensor(const std::string                                &name,
                                    const std::vector<dealii::SymmetricTensor<2, 3>> &values)
  {
    std::vector<double> component(values.size());
    for (const auto &[suffix, a, b] : tensor_components<dim>())
      {
        for (std::size_t i = 0; i < values.size(); ++i)
          component[i] = values[i][a][b];
        add_scalar(name + "_" + suffix, component);
      }
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
    const std::string name = filename(step);
    write_vtu(directory + "/" + name, step, time);
    list_in_pvd(name, time);
    vectors.clear();
    scalars.clear();
  }

  template <int dim>
  std::string FieldOutput<dim>::filename(const unsigned int step) const
  {
    return steps == OutputSteps::single ? "solution.vtu" :
                                          "solution_" + dealii::Utilities::int_to_string(step, 4) + ".vtu";
  }

  template <int dim>
  void FieldOutput<dim>::write_vtu(const std::string &path, const unsigned int step, const double time) const
  {
    OpenDataOut<dim>              data_out;
    dealii::DataOutBase::VtkFlags flags(time, step);
    // Equal runs leave equal files.
    flags.print_date_and_time = false;
    flags.compression_level   = dealii::DataOutBase::VtkFlags::best_speed;
    data_out.set_flags(flags);

    data_out.attach_triangulation(triangulation);
    const std::vector<dealii::DataComponentInterpretation::DataComponentInterpretation> is_vector(
      dim, dealii::DataComponentInterpretation::component_is_part_of_vector);
    for (const auto &[name, values] : vectors)
      data_out.add_data_vector(vector_unknowns, values, std::vector<std::string>(dim, name), is_vector);
    for (const auto &[name, values] : scalars)
      data_out.add_data_vector(values, name, dealii::DataOut<dim>::type_cell_data);

    // A constant needs the corners of its cell and nothing between.
    data_out.build_patches(1);
    std::ostringstream text;
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    if (rank == 0)
      dealii::DataOutBase::write_vtu_header(text, flags);
    if (rank == 0 || !data_out.get_patches().empty())
      dealii::DataOutBase::write_vtu_main(data_out.get_patches(),
                                          data_out.get_dataset_names(),
                                          data_out.get_nonscalar_data_ranges(),
                                          flags,
                                          text);
    if (rank + 1 == dealii::Utilities::MPI::n_mpi_processes(communicator))
      dealii::DataOutBase::write_vtu_footer(text);
    write_texts(path, text.str(), communicator);
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

  PERIDEAL_INSTANTIATE_CLASS(FieldOutput)
} // namespace perideal
