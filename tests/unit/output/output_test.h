// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_tests_output_test_h
#define perideal_tests_output_test_h

#include <perideal/nodes/nodes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

/// What the tests of this room share.
namespace output_test
{
  inline bool is_first_rank()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }

  /// An absent directory of the test's own, under the working directory; runs
  /// with different numbers of ranks may go on at the same time.
  inline std::string scratch_directory(const std::string &name)
  {
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    const std::string  path    = "scratch_output/" + name + "_" + std::to_string(n_ranks);
    // No rank may still be reading what an earlier use of the name left.
    MPI_Barrier(MPI_COMM_WORLD);
    if (is_first_rank())
      std::filesystem::remove_all(path);
    MPI_Barrier(MPI_COMM_WORLD);
    return path;
  }

  /// The whole file, on all ranks once all have reached this line.
  inline std::string read_text(const std::string &path)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  /// Lines of a file.
  inline std::vector<std::string> read_lines(const std::string &path)
  {
    std::istringstream       text(read_text(path));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);)
      lines.push_back(line);
    return lines;
  }

  /// Numbers of a CSV file, without its header.
  inline std::vector<std::vector<double>> read_csv(const std::string &path)
  {
    const auto                       lines = read_lines(path);
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 1; i < lines.size(); ++i)
      {
        rows.emplace_back();
        std::istringstream line(lines[i]);
        for (std::string cell; std::getline(line, cell, ',');)
          rows.back().push_back(std::stod(cell));
      }
    return rows;
  }

  /// A block of n^dim cells with edges 1, 2 and 3, so that no two directions are alike.
  template <int dim>
  void make_block(perideal::Mesh<dim> &mesh, const unsigned int n)
  {
    dealii::Point<dim> corner;
    for (unsigned int d = 0; d < dim; ++d)
      corner[d] = 1 + d;
    dealii::GridGenerator::subdivided_hyper_rectangle(
      mesh.triangulation, std::vector<unsigned int>(dim, n), dealii::Point<dim>(), corner, true);
  }

  /// A field that tells the cells and the components apart.
  template <int dim>
  dealii::Tensor<1, dim> sample(const dealii::Point<dim> &x)
  {
    dealii::Tensor<1, dim> value;
    for (unsigned int d = 0; d < dim; ++d)
      value[d] = (d + 1) * x[0] + 10 * x[1] * x[1] + 100 * x[dim - 1];
    return value;
  }

  template <int dim>
  std::vector<dealii::Tensor<1, dim>> sample_at_nodes(const perideal::Nodes<dim> &nodes)
  {
    std::vector<dealii::Tensor<1, dim>> values;
    for (const auto &x : nodes.position)
      values.push_back(sample(x));
    return values;
  }
} // namespace output_test

#endif
