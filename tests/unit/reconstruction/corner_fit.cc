// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/reconstruction/corner_fit.h>

#include "bodies.h"

#include <gtest/gtest.h>

using namespace perideal;

namespace
{
  /// u = (1 + 2x - 3y, ...), different along each axis.
  template <int dim>
  dealii::Tensor<1, dim> linear(const dealii::Point<dim> &x)
  {
    dealii::Tensor<1, dim> result;
    for (int a = 0; a < dim; ++a)
      {
        result[a] = 1. + a;
        for (int b = 0; b < dim; ++b)
          result[a] += (2. * a - 3. * b + 1.) * x[b];
      }
    return result;
  }

  /// The largest error at corners of a linear field, over a size of its values.
  template <int dim>
  double largest_error(const Mesh<dim> &mesh, const bool is_plane)
  {
    const Nodes<dim> nodes(mesh, NodeParameters());
    const auto       graph = std::make_shared<const CellGraph<dim>>(mesh, nodes);
    MeshPoints<dim>  points(mesh, graph);
    // A crack through the middle.
    points.open([&](const LocalIndex i, const LocalIndex j) {
      return (graph->position[i][0] < 0.5) != (graph->position[j][0] < 0.5);
    });
    const auto at = [&](dealii::Point<dim> x, const double side) {
      if (is_plane)
        x[dim - 1] = 0;
      auto result = linear(x);
      result[0] += side < 0.5 ? 0. : 100.;
      return result;
    };
    std::vector<dealii::Tensor<1, dim>> values;
    for (const auto &x : graph->position)
      values.push_back(at(x, x[0]));
    double error = 0;
    for (LocalIndex i = 0; i < nodes.size(); ++i)
      {
        const auto fitted = fit_at_corners(points, i, values);
        for (unsigned int v = 0; v < fitted.size(); ++v)
          error =
            std::max(error, (fitted[v] - at(points.cell(i)->vertex(v), nodes.position[i][0])).norm() / 100.);
      }
    return error;
  }
} // namespace

TEST(CornerFit, ReproducesLinearFieldsOnEitherSideOfACrack)
{
  // Round-off.
  EXPECT_LT(largest_error<2>(*test::make_box<2>({6, 6}, {1., 1.}, 0.), false), 1e-13);
  EXPECT_LT(largest_error<3>(*test::make_box<3>({4, 4, 4}, {1., 1., 1.}, 0.), false), 1e-13);
}

TEST(CornerFit, IsConstantAcrossBodiesOfOneCell)
{
  EXPECT_LT(largest_error<3>(*test::make_box<3>({4, 4, 1}, {1., 1., 0.1}, 0.), true), 1e-13);
}

TEST(CornerFit, ReproducesLinearFieldsOnDistortedCells)
{
  const auto                        mesh = test::make_box<2>({6, 6}, {1., 1.}, 0.2);
  const Nodes<2>                    nodes(*mesh, NodeParameters());
  const auto                        graph = std::make_shared<const CellGraph<2>>(*mesh, nodes);
  const MeshPoints                  points(*mesh, graph);
  std::vector<dealii::Tensor<1, 2>> values;
  for (const auto &x : graph->position)
    values.push_back(linear(x));
  for (LocalIndex i = 0; i < nodes.size(); ++i)
    {
      const auto fitted = fit_at_corners(points, i, values);
      for (unsigned int v = 0; v < 4; ++v)
        EXPECT_LT((fitted[v] - linear<2>(points.cell(i)->vertex(v))).norm(), 1e-12);
    }
}
