// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_test.h"
#include "vtu_reader.h"

#include <perideal/base/exceptions.h>
#include <perideal/output/field_output.h>

#include <gtest/gtest.h>

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

  unsigned int count(const std::string &text, const std::string &part)
  {
    unsigned int n = 0;
    for (auto i = text.find(part); i != std::string::npos; i = text.find(part, i + 1))
      ++n;
    return n;
  }
} // namespace

TYPED_TEST(FieldOutputTest, EveryCellHasTheValueOfItsNode)
{
  constexpr int      dim        = TypeParam::value;
  constexpr unsigned n_vertices = 1 << dim;
  Mesh<dim>          mesh(MPI_COMM_WORLD);
  make_block(mesh, 4);
  const Nodes<dim> nodes(mesh, NodeParameters());

  const auto          directory = scratch_directory("fields_" + std::to_string(dim));
  FieldOutput<dim>    output(mesh, nodes, directory, OutputSteps::single);
  std::vector<double> heights;
  for (const auto &x : nodes.position)
    heights.push_back(x[dim - 1]);
  output.add_vector("displacement", sample_at_nodes(nodes));
  output.add_scalar("height", heights);
  output.write(0, 0.);

  const std::string vtu     = read_text(directory + "/solution.vtu");
  const auto        points  = read_data_arrays<float>(vtu, "\"Float32\" NumberOfComponents");
  const auto        vectors = read_data_arrays<float>(vtu, "Name=\"displacement\" NumberOfComponents=\"3\"");
  const auto        scalars = read_data_arrays<float>(vtu, "Name=\"height\"");
  ASSERT_EQ(points.size(), dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));

  GlobalIndex n_cells = 0;
  for (std::size_t piece = 0; piece < points.size(); ++piece)
    for (std::size_t cell = 0; cell < points[piece].size() / (3 * n_vertices); ++cell, ++n_cells)
      {
        dealii::Point<dim> centre;
        for (unsigned int v = 0; v < n_vertices; ++v)
          for (unsigned int d = 0; d < dim; ++d)
            centre[d] += points[piece][3 * (cell * n_vertices + v) + d] / n_vertices;
        for (unsigned int v = 0; v < n_vertices; ++v)
          {
            // Values up to 500 in single precision, whose unit round-off is 6e-8.
            const std::size_t point = cell * n_vertices + v;
            for (unsigned int d = 0; d < 3; ++d)
              EXPECT_NEAR(vectors[piece][3 * point + d], d < dim ? sample(centre)[d % dim] : 0., 1e-3);
            EXPECT_NEAR(scalars[piece][point], centre[dim - 1], 1e-5);
          }
      }
  EXPECT_EQ(n_cells, nodes.n_global);
}

TYPED_TEST(FieldOutputTest, TensorsAreScalarsByComponent)
{
  constexpr int dim = TypeParam::value;
  Mesh<dim>     mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<dim>              nodes(mesh, NodeParameters());
  const auto                    directory = scratch_directory("tensors_" + std::to_string(dim));
  FieldOutput<dim>              output(mesh, nodes, directory, OutputSteps::single);
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
  FieldOutput<2> output(mesh, nodes, directory, OutputSteps::series);

  output.add_vector("displacement", sample_at_nodes(nodes));
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
  EXPECT_EQ(second.find("displacement"), std::string::npos);
  EXPECT_NE(second.find("damage"), std::string::npos);
}

TEST(FieldOutput, SingleOutputKeepsTheLast)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<2> nodes(mesh, NodeParameters());
  const auto     directory = scratch_directory("single");
  FieldOutput<2> output(mesh, nodes, directory, OutputSteps::single);
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
  EXPECT_THROW(FieldOutput<2>(mesh, nodes, "/dev/null/below", OutputSteps::single), InputError);
}

TEST(FieldOutput, DirectoryThatVanishesIsAComputationError)
{
  Mesh<2> mesh(MPI_COMM_WORLD);
  make_block(mesh, 3);
  const Nodes<2> nodes(mesh, NodeParameters());
  const auto     directory = scratch_directory("vanishes");
  FieldOutput<2> output(mesh, nodes, directory, OutputSteps::series);
  scratch_directory("vanishes");
  output.add_scalar("damage", std::vector<double>(nodes.size(), 0.));
  EXPECT_THROW(output.write(1, 0.), ComputationError);
}
