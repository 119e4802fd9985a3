// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/point_forces.h>

#include "bodies.h"
#include "testing.h"

using namespace perideal;
using test::expect_input_error;

namespace
{
  template <int dim>
  std::string coordinates(const dealii::Point<dim> &point)
  {
    std::ostringstream text;
    text.precision(17);
    for (int d = 0; d < dim; ++d)
      text << (d > 0 ? ", " : "") << point[d];
    return text.str();
  }

  template <int dim>
  NodalVector forces_of(const Mesh<dim> &mesh, const Nodes<dim> &nodes, const dealii::Point<dim> &point)
  {
    LoadParameters text;
    text.point_loads.push_back({"load", coordinates(point), {{"2", "-3*t", dim == 3 ? "4" : ""}}});
    const Loads<dim> loads(text);
    dealii::IndexSet owned(dim * nodes.n_global);
    owned.add_range(dim * nodes.first_global, dim * (nodes.first_global + nodes.size()));
    NodalVector force(owned, MPI_COMM_WORLD);
    PointForces<dim>(mesh, CellGraph<dim>(mesh, nodes), loads).add(loads, 2., force);
    return force;
  }

  /// The force and all its first moments: sum f_i (x) x_i = F (x) x.
  template <int dim>
  void expect_force_and_moments()
  {
    dealii::Tensor<1, dim> force;
    force[0] = 2;
    force[1] = -6;
    if (dim == 3)
      force[dim - 1] = 4;
    for (const auto &mesh : test::make_boxes<dim>())
      {
        const Nodes<dim>                nodes(*mesh, NodeParameters{3.01});
        const auto                     &vertices = mesh->triangulation.get_vertices();
        std::vector<dealii::Point<dim>> points(3);
        for (int d = 0; d < dim; ++d)
          {
            points[0][d] = 0.;         // a corner
            points[1][d] = d * 0.0873; // on an edge of the body
            points[2][d] = 0.21 + 0.08 * d;
          }
        // A vertex that cells of several ranks may share.
        const auto middle =
          *std::min_element(vertices.begin(), vertices.end(), [&](const auto &a, const auto &b) {
            return a.distance(points[2]) < b.distance(points[2]);
          });
        points.push_back(dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD, middle, 0));
        for (const dealii::Point<dim> &point : points)
          {
            const NodalVector      f = forces_of(*mesh, nodes, point);
            dealii::Tensor<1, dim> sum;
            dealii::Tensor<2, dim> moments;
            for (LocalIndex i = 0; i < nodes.size(); ++i)
              {
                dealii::Tensor<1, dim> of_node;
                for (int d = 0; d < dim; ++d)
                  of_node[d] = f.local_element(dim * i + d);
                sum += of_node;
                moments += outer_product(of_node, dealii::Tensor<1, dim>(nodes.position[i]));
              }
            sum     = dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
            moments = dealii::Utilities::MPI::sum(moments, MPI_COMM_WORLD);
            EXPECT_LE((sum - force).norm(), 1e-11) << point;
            EXPECT_LE((moments - outer_product(force, dealii::Tensor<1, dim>(point))).norm(), 1e-11) << point;
          }
      }
  }
} // namespace

TEST(PointForces, CarryForceAndMomentsWhereverTheyAct)
{
  expect_force_and_moments<2>();
  expect_force_and_moments<3>();
}

/// A force on the line between two cells burdens both alike.
TEST(PointForces, AreAsSymmetricAsTheMesh)
{
  const auto        mesh = test::make_box<2>({4, 4}, {1., 1.}, 0.);
  const Nodes<2>    nodes(*mesh, NodeParameters{3.01});
  const NodalVector f       = forces_of<2>(*mesh, nodes, {0.5, 1.});
  double            largest = 0, left = 0, right = 0;
  for (LocalIndex i = 0; i < nodes.size(); ++i)
    {
      const double value = std::abs(f.local_element(2 * i));
      largest            = std::max(largest, value);
      (nodes.position[i][0] < 0.5 ? left : right) += value;
    }
  EXPECT_GT(dealii::Utilities::MPI::max(largest, MPI_COMM_WORLD), 0.1);
  EXPECT_NEAR(dealii::Utilities::MPI::sum(left, MPI_COMM_WORLD),
              dealii::Utilities::MPI::sum(right, MPI_COMM_WORLD),
              1e-13);
}

TEST(PointForces, OutsideTheBodyAreErrors)
{
  const auto     mesh = test::make_box<2>({4, 4}, {1., 1.}, 0.);
  const Nodes<2> nodes(*mesh, NodeParameters{3.01});
  forces_of<2>(*mesh, nodes, {0.3, 1.02}); // within a tenth of a cell
  expect_input_error(
    [&] {
      forces_of<2>(*mesh, nodes, {0.3, 1.03});
    },
    {"load/Point", "0.3, 1.03", "outside"});
}
