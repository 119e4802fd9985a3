// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_test.h"
#include "vtu_reader.h"

#include <perideal/base/exceptions.h>
#include <perideal/output/field_output.h>

#include <gtest/gtest.h>

#include <memory>

using namespace perideal;
using namespace output_test;

namespace
{
  template <typename Dimension>
  class FieldOutputTest : public testing::Test
  {
  };
  using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
  TYPED_TEST_SUITE(FieldOutputTest, Dimensions);

  template <int dim>
  FieldOutput<dim> make_output(const Mesh<dim>   &mesh,
                               const Nodes<dim>  &nodes,
                               const std::string &directory,
                               const OutputSteps  steps,
                               const OutputFormat format = OutputFormat::vtu)
  {
    const auto graph = std::make_shared<const CellGraph<dim>>(mesh, nodes);
    return {mesh, nodes, std::make_unique<MeshPoints<dim>>(mesh, graph), directory, steps, format};
  }

  unsigned int count(const std::string &text, const std::string &part)
  {
    unsigned int n = 0;
    for (auto i = text.find(part); i != std::string::npos; i = text.find(part, i + 1))
      ++n;
    return n;
  }
} // namespace

TYPED_TEST(FieldOutputTest, CellsShareTheirPoints)
{
  constexpr int      dim        = TypeParam::value;
  constexpr unsigned n_vertices = 1 << dim;
  Mesh<dim>          mesh(MPI_COMM_WORLD);
  make_block(mesh, 4);
  const Nodes<dim> nodes(mesh, NodeParameters());
  for (const OutputFormat format : {OutputFormat::vtu, OutputFormat::pvtu})
    {
      const auto directory = scratch_directory("fields_" + std::to_string(dim) + "_" + name_of(format));
      auto       output    = make_output(mesh, nodes, directory, OutputSteps::single, format);
      std::vector<double>            heights;
      std::vector<CornerValues<dim>> at_corners(nodes.size());
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          heights.push_back(nodes.position[i][dim - 1]);
          for (unsigned int v = 0; v < n_vertices; ++v)
            at_corners[i][v] = sample<dim>(output.points()->cell(i)->vertex(v));
        }
      output.add_vector("velocity", sample_at_nodes(nodes));
      output.add_at_points("displacement", at_corners);
      output.add_scalar("height", heights);
      output.write(0, 0.);

      const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const unsigned int n_files = format == OutputFormat::vtu ? 1 : n_ranks;
      GlobalIndex        n_cells = 0;
      for (unsigned int file = 0; file < n_files; ++file)
        {
          const std::string vtu     = read_text(directory + (format == OutputFormat::vtu ?
                                                               "/solution.vtu" :
                                                               "/solution_000" + std::to_string(file) + ".vtu"));
          const auto        points  = read_data_arrays<float>(vtu, "\"Points\"").at(0);
          const auto        corners = read_data_arrays<std::int64_t>(vtu, "\"connectivity\"").at(0);
          const auto moved = read_data_arrays<float>(vtu, "\"displacement\" NumberOfComponents=\"3\"").at(0);
          const auto vectors = read_data_arrays<float>(vtu, "\"velocity\" NumberOfComponents=\"3\"").at(0);
          const auto scalars = read_data_arrays<float>(vtu, "\"height\"").at(0);
          if (format == OutputFormat::vtu)
            {
              EXPECT_EQ(points.size(), 3 * (dim == 2 ? 25u : 125u));
            }
          ASSERT_EQ(moved.size(), points.size());
          ASSERT_EQ(n_vertices * scalars.size(), corners.size());
          // Values up to 500 in single precision, whose unit round-off is 6e-8.
          for (std::size_t p = 0; p < points.size() / 3; ++p)
            {
              dealii::Point<dim> x;
              for (unsigned int d = 0; d < dim; ++d)
                x[d] = points[3 * p + d];
              for (unsigned int d = 0; d < 3; ++d)
                EXPECT_NEAR(moved[3 * p + d], d < dim ? sample(x)[d % dim] : 0., 1e-3);
            }
          for (std::size_t cell = 0; cell < scalars.size(); ++cell, ++n_cells)
            {
              dealii::Point<dim> centre;
              for (unsigned int v = 0; v < n_vertices; ++v)
                for (unsigned int d = 0; d < dim; ++d)
                  centre[d] += points[3 * corners[cell * n_vertices + v] + d] / n_vertices;
              for (unsigned int d = 0; d < 3; ++d)
                EXPECT_NEAR(vectors[3 * cell + d], d < dim ? sample(centre)[d % dim] : 0., 1e-3);
              EXPECT_NEAR(scalars[cell], centre[dim - 1], 1e-5);
              // VTK's corners go round: opposite ones of the first face stand two apart.
              const auto corner = [&](const unsigned int v, const unsigned int d) {
                return points[3 * corners[cell * n_vertices + v] + d];
              };
              for (const unsigned int d : {0, 1})
                EXPECT_NEAR(corner(0, d) + corner(2, d), corner(1, d) + corner(3, d), 1e-5);
              EXPECT_GT((corner(1, 0) - corner(0, 0)) * (corner(3, 1) - corner(0, 1)), 0.);
            }
        }
      EXPECT_EQ(n_cells, nodes.n_global);
      if (format == OutputFormat::pvtu)
        {
          const std::string list = read_text(directory + "/solution.pvtu");
          EXPECT_EQ(count(list, "<Piece Source=\"solution_000"), n_ranks);
          EXPECT_EQ(count(list, "<PDataArray"), 4u);
          EXPECT_NE(read_text(directory + "/solution.pvd").find("solution.pvtu"), std::string::npos);
        }
    }
}

TYPED_TEST(FieldOutputTest, TensorsAreScalarsByComponent)
{
  constexpr int dim = TypeParam::value;
  Mesh<dim>     mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<dim>              nodes(mesh, NodeParameters());
  const auto                    directory = scratch_directory("tensors_" + std::to_string(dim));
  auto                          output    = make_output(mesh, nodes, directory, OutputSteps::single);
  dealii::SymmetricTensor<2, 3> tensor;
  for (unsigned int k = 0; k < 6; ++k)
    tensor.access_raw_entry(k) = k + 1.;
  output.add_tensor("stress", std::vector<dealii::SymmetricTensor<2, 3>>(nodes.size(), tensor));
  output.write(0, 0.);

  const std::string vtu = read_text(directory + "/solution.vtu");
  EXPECT_EQ(count(vtu, "Name=\"stress_"), (dim == 2 ? 4 : 6) * count(vtu, "Name=\"connectivity\""));
  const std::vector<std::pair<std::string, double>> expected = {{"xx", tensor[0][0]},
                                                                {"yy", tensor[1][1]},
                                                                {"zz", tensor[2][2]},
                                                                {"xy", tensor[0][1]},
                                                                {"yz", tensor[1][2]},
                                                                {"zx", tensor[2][0]}};
  for (const auto &[suffix, value] : expected)
    for (const auto &piece : read_data_arrays<float>(vtu, "Name=\"stress_" + suffix + "\""))
      for (const float read : piece)
        EXPECT_EQ(read, static_cast<float>(value));
}

TEST(FieldOutput, PvdListsWhatIsWritten)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<2> nodes(mesh, NodeParameters());
  const auto     directory = scratch_directory("series");
  auto           output    = make_output(mesh, nodes, directory, OutputSteps::series);

  output.add_vector("velocity", sample_at_nodes(nodes));
  output.write(1, 1.25e-7);
  std::string pvd = read_text(directory + "/solution.pvd");
  EXPECT_EQ(count(pvd, "<DataSet"), 1u);
  EXPECT_NE(pvd.find("timestep=\"1.25e-07\""), std::string::npos) << pvd;
  EXPECT_NE(pvd.find("file=\"solution_0001.vtu\""), std::string::npos) << pvd;
  EXPECT_EQ(count(pvd, "</VTKFile>"), 1u);
  MPI_Barrier(MPI_COMM_WORLD);

  output.add_scalar("damage", std::vector<double>(nodes.size(), 0.5));
  output.write(12, 3.5);
  pvd = read_text(directory + "/solution.pvd");
  EXPECT_EQ(count(pvd, "<DataSet"), 2u);
  EXPECT_NE(pvd.find("timestep=\"3.5\""), std::string::npos) << pvd;
  EXPECT_NE(pvd.find("file=\"solution_0012.vtu\""), std::string::npos) << pvd;

  // Fields belong to one write.
  const std::string second = read_text(directory + "/solution_0012.vtu");
  EXPECT_EQ(second.find("velocity"), std::string::npos);
  EXPECT_NE(second.find("damage"), std::string::npos);
}

TEST(FieldOutput, SingleOutputKeepsTheLast)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<2> nodes(mesh, NodeParameters());
  const auto     directory = scratch_directory("single");
  auto           output    = make_output(mesh, nodes, directory, OutputSteps::single);
  for (const unsigned int step : {0, 1})
    {
      output.add_scalar("step", std::vector<double>(nodes.size(), step));
      output.write(step, step);
    }
  const std::string pvd = read_text(directory + "/solution.pvd");
  EXPECT_EQ(count(pvd, "<DataSet"), 1u);
  EXPECT_NE(pvd.find("timestep=\"1\""), std::string::npos) << pvd;
  for (const auto &piece : read_data_arrays<float>(read_text(directory + "/solution.vtu"), "Name=\"step\""))
    for (const float value : piece)
      EXPECT_EQ(value, 1.f);
}

TEST(FieldOutput, UnwritableDirectoryIsAnInputError)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<2> nodes(mesh, NodeParameters());
  EXPECT_THROW(make_output(mesh, nodes, "/dev/null/below", OutputSteps::single), InputError);
}

TEST(FieldOutput, DirectoryThatVanishesIsAComputationError)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<2> nodes(mesh, NodeParameters());
  const auto     directory = scratch_directory("vanishes");
  auto           output    = make_output(mesh, nodes, directory, OutputSteps::series);
  scratch_directory("vanishes");
  output.add_scalar("damage", std::vector<double>(nodes.size(), 0.));
  EXPECT_THROW(output.write(1, 0.), ComputationError);
}
