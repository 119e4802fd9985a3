// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/gauges.h>

#include "bodies.h"
#include "testing.h"

using namespace perideal;
using test::expect_input_error;

namespace
{
  /// A gauge across the body, from its boundary to its inside.
  template <int dim>
  std::vector<Gauge<dim>> some_gauges()
  {
    GaugeParameters parameters;
    parameters.gauges = {
      {"across", dim == 2 ? "0, 0" : "0, 0, 0", dim == 2 ? "0.31, 0.22" : "0.31, 0.22, 0.17"},
      {"along", dim == 2 ? "0, 0.1" : "0, 0.1, 0.1", dim == 2 ? "0.5, 0.1" : "0.5, 0.1, 0.1"}};
    return read_gauges<dim>(parameters);
  }

  /// The displacement F x - x + shift at the nodes.
  template <int dim>
  NodalVector
  linear_field(const Nodes<dim> &nodes, const dealii::Tensor<2, dim> &F, const dealii::Tensor<1, dim> &shift)
  {
    dealii::IndexSet owned(dim * nodes.n_global);
    owned.add_range(dim * nodes.first_global, dim * (nodes.first_global + nodes.size()));
    NodalVector result(owned, MPI_COMM_WORLD);
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        const dealii::Tensor<1, dim> value = F * nodes.position[i] - nodes.position[i] + shift;
        for (int d = 0; d < dim; ++d)
          result.local_element(dim * i + d) = value[d];
      }
    return result;
  }

  template <int dim>
  void expect_stretch_of_linear_fields()
  {
    const double           c = std::cos(2.), s = std::sin(2.);
    dealii::Tensor<2, dim> stretch, turn       = dealii::unit_symmetric_tensor<dim>();
    for (int d = 0; d < dim; ++d)
      stretch[d][d] = 1.3 - 0.4 * d;
    stretch[0][1] = 0.2;
    turn[0][0] = turn[1][1] = c;
    turn[0][1]              = -s;
    turn[1][0]              = s;
    dealii::Tensor<1, dim> shift;
    shift[0] = 3.;
    for (const auto &mesh : test::make_boxes<dim>())
      {
        const Nodes<dim>  nodes(*mesh, NodeParameters{3.01});
        const auto        list = some_gauges<dim>();
        const Gauges<dim> gauges(*mesh, CellGraph<dim>(*mesh, nodes), list);
        // Rotations and shifts change nothing.
        for (const auto &F : {dealii::Tensor<2, dim>(turn), dealii::Tensor<2, dim>(turn * stretch)})
          {
            const auto readings = gauges.read(linear_field<dim>(nodes, F, shift));
            ASSERT_EQ(readings.size(), list.size());
            for (std::size_t k = 0; k < list.size(); ++k)
              {
                const dealii::Tensor<1, dim> arm   = list[k].to - list[k].from;
                const double                 exact = (F * arm).norm() / arm.norm();
                // Linear fields are reproduced to round-off.
                EXPECT_NEAR(readings[k].stretch, exact, 1e-11);
                EXPECT_NEAR(readings[k].elongation, (exact - 1.) * arm.norm(), 1e-11);
              }
          }
      }
  }
} // namespace

TEST(Gauges, FollowStretchesAndNoRotations)
{
  expect_stretch_of_linear_fields<2>();
  expect_stretch_of_linear_fields<3>();
}

TEST(Gauges, KeepTheDigitsOfSmallStrains)
{
  const auto           mesh = test::make_box<2>({4, 4}, {1., 1.}, 0.);
  const Nodes<2>       nodes(*mesh, NodeParameters{3.01});
  const Gauges<2>      gauges(*mesh, CellGraph<2>(*mesh, nodes), {{"along", {0.25, 0.5}, {0.75, 0.5}}});
  dealii::Tensor<2, 2> F = dealii::unit_symmetric_tensor<2>();
  F[0][0] += 1e-9;
  // F - I is rounded by 1e-16; a difference of two lengths would keep seven digits of the elongation.
  EXPECT_NEAR(gauges.read(linear_field<2>(nodes, F, {}))[0].elongation / 0.5e-9, 1., 1e-6);
}

TEST(Gauges, NameWhatIsWrong)
{
  const auto         mesh = test::make_box<2>({4, 4}, {1., 1.}, 0.);
  const Nodes<2>     nodes(*mesh, NodeParameters{3.01});
  const CellGraph<2> graph(*mesh, nodes);
  expect_input_error(
    [&] {
      Gauges<2>(*mesh, graph, {{"wide", {0., 0.5}, {1.1, 0.5}}});
    },
    {"Gauges/wide/To", "1.1, 0.5", "outside"});
  GaugeParameters parameters;
  parameters.gauges = {{"short", "0, 0", "0, 0"}};
  expect_input_error([&] { read_gauges<2>(parameters); }, {"Gauges/short/To", "no length"});
}
