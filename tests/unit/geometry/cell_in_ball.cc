// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/geometry/cell_in_ball.h>
#include <perideal/mesh/create_mesh.h>

#include "bodies.h"
#include "testing.h"

#include <deal.II/base/numbers.h>

#include <cmath>

using namespace perideal;
using dealii::numbers::PI;

namespace
{
  /// A box along the axes.
  template <int dim>
  CellVertices<dim> box(const dealii::Point<dim> &lower, const dealii::Point<dim> &upper)
  {
    CellVertices<dim> result;
    for (unsigned int v = 0; v < result.size(); ++v)
      for (int d = 0; d < dim; ++d)
        result[v][d] = (v >> d) & 1u ? upper[d] : lower[d];
    return result;
  }

  /// The parallelepiped that edges span at a corner.
  CellVertices<3> parallelepiped(const dealii::Point<3> &corner, const dealii::Tensor<2, 3> &edges)
  {
    CellVertices<3> result;
    for (unsigned int v = 0; v < 8; ++v)
      {
        result[v] = corner;
        for (int d = 0; d < 3; ++d)
          if ((v >> d) & 1u)
            result[v] += edges[d];
      }
    return result;
  }

  /// Volume of the unit ball beyond a plane at height @p h, and its first moment across the plane.
  double cap(const double h)
  {
    return PI / 3 * (1 - h) * (1 - h) * (2 + h);
  }
  double cap_moment(const double h)
  {
    return PI / 4 * std::pow(1 - h * h, 2);
  }

  template <int dim>
  dealii::Point<dim> everywhere(const double value)
  {
    dealii::Point<dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = value;
    return result;
  }

  /// Whatever the cells, those of a mesh together hold a ball inside it.
  template <int dim>
  void expect_whole_ball(const Mesh<dim> &mesh, const dealii::Point<dim> &centre, const double radius)
  {
    double                 volume = 0, all = 0;
    dealii::Tensor<1, dim> moment;
    for (const auto &cell : mesh.triangulation.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          CellVertices<dim> vertices;
          for (const unsigned int v : cell->vertex_indices())
            vertices[v] = cell->vertex(v);
          const auto part = moments_in_ball<dim>(vertices, centre, radius);
          EXPECT_NEAR(part.volume, volume_in_ball<dim>(vertices, centre, radius), 1e-13 * cell->measure());
          volume += part.volume;
          moment += part.moment;
          all += cell_volume<dim>(vertices);
          EXPECT_NEAR(cell_volume<dim>(vertices), cell->measure(), 1e-12 * cell->measure());
        }
    volume = dealii::Utilities::MPI::sum(volume, MPI_COMM_WORLD);
    moment = dealii::Utilities::MPI::sum(moment, MPI_COMM_WORLD);
    // Measured 1e-14 and less; vertices are read with 16 digits.
    const double exact = dim == 2 ? PI * radius * radius : 4 * PI / 3 * std::pow(radius, 3);
    EXPECT_NEAR(volume, exact, 1e-10 * exact);
    EXPECT_LT((moment / volume - centre).norm(), 1e-10 * radius);
  }

  template <int dim>
  std::unique_ptr<Mesh<dim>> read_mesh(const std::string &file)
  {
    MeshParameters parameters;
    parameters.file = file;
    return create_mesh<dim>(parameters, MPI_COMM_WORLD, "");
  }
} // namespace

TEST(CellInBall, InsideAndOutside)
{
  const auto cube = box<3>(everywhere<3>(1.), everywhere<3>(2.));
  EXPECT_EQ(volume_in_ball<3>(cube, {}, 1.7), 0.);
  EXPECT_EQ(place_of<3>(cube, {}, 1.7), PlaceOfCell::outside);
  EXPECT_NEAR(volume_in_ball<3>(cube, {}, 3.5), 1., 1e-14);
  EXPECT_EQ(place_of<3>(cube, {}, 3.5), PlaceOfCell::inside);
  EXPECT_NEAR((moments_in_ball<3>(cube, {}, 3.5).centroid() - everywhere<3>(1.5)).norm(), 0., 1e-14);
  // The box around a cell may touch the ball where the cell does not.
  const auto kite = parallelepiped({1., 1., 0.}, dealii::Tensor<2, 3>({{1, -1, 0}, {1, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(place_of<3>(kite, {}, 1.2), PlaceOfCell::perhaps_cut);
  EXPECT_NEAR(volume_in_ball<3>(kite, {}, 1.2), 0., 1e-14);

  const auto square = box<2>(everywhere<2>(1.), everywhere<2>(2.));
  EXPECT_EQ(volume_in_ball<2>(square, {}, 1.4), 0.);
  EXPECT_NEAR(volume_in_ball<2>(square, {}, 2.9), 1., 1e-14);
}

TEST(CellInBall, BallInsideTheCell)
{
  const dealii::Point<3> centre(0.1, -0.2, 0.3);
  const auto whole = moments_in_ball<3>(box<3>(everywhere<3>(-2.), everywhere<3>(2.)), centre, 1.);
  EXPECT_NEAR(whole.volume, 4 * PI / 3, 1e-12);
  EXPECT_LT(whole.centroid().distance(centre), 1e-12);
  const auto disk =
    moments_in_ball<2>(box<2>(everywhere<2>(-2.), everywhere<2>(2.)), dealii::Point<2>(0.1, 0.2), 1.);
  EXPECT_NEAR(disk.volume, PI, 1e-12);
  EXPECT_LT(disk.centroid().distance(dealii::Point<2>(0.1, 0.2)), 1e-12);
}

/// The centre on faces, edges and vertices.
TEST(CellInBall, CentreOnTheSurface)
{
  const dealii::Point<3> upper = everywhere<3>(2.);
  for (int n = 0; n <= 3; ++n)
    {
      // On n faces at once.
      dealii::Point<3> lower = everywhere<3>(-2.);
      for (int d = 0; d < n; ++d)
        lower[d] = 0.;
      const auto part = moments_in_ball<3>(box<3>(lower, upper), {}, 1.);
      EXPECT_NEAR(part.volume, 4 * PI / 3 / (1 << n), 1e-12) << n;
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(part.centroid()[d], d < n ? 3. / 8 : 0., 1e-12) << n << d;
    }
  const auto quarter = moments_in_ball<2>(box<2>({0., 0.}, {2., 2.}), {}, 1.);
  EXPECT_NEAR(quarter.volume, PI / 4, 1e-12);
  EXPECT_NEAR(quarter.centroid()[0], 4 / (3 * PI), 1e-12);
  // Next to it by round-off.
  for (const double off : {-1e-9, 1e-12, 1e-15, -1e-15})
    {
      EXPECT_NEAR(
        volume_in_ball<3>(box<3>({off, off, 0.}, upper), {}, 1.), PI / 6, 4 * std::abs(off) + 1e-12);
      // Coplanar with a face beside it.
      EXPECT_NEAR(
        volume_in_ball<3>(box<3>({off, 0.3, -2.}, upper), {}, 1.), cap(0.3) / 2, 4 * std::abs(off) + 1e-12);
    }
}

TEST(CellInBall, Caps)
{
  for (const double h : {-0.99, -0.5, -1e-3, 0., 0.2, 0.7, 0.999})
    {
      const auto part = moments_in_ball<3>(box<3>({h, -2., -2.}, everywhere<3>(2.)), {}, 1.);
      EXPECT_NEAR(part.volume, cap(h), 1e-12) << h;
      EXPECT_NEAR(part.moment[0], cap_moment(h), 1e-12) << h;
      EXPECT_NEAR(part.moment[1], 0., 1e-12) << h;
    }
  // Four caps off that do not meet.
  const auto cut = moments_in_ball<3>(box<3>({-0.8, -0.75, -2.}, {0.9, 0.7, 2.}), {}, 1.);
  EXPECT_NEAR(cut.volume, 4 * PI / 3 - cap(0.8) - cap(0.75) - cap(0.9) - cap(0.7), 1e-12);
  EXPECT_NEAR(cut.moment[0], cap_moment(0.8) - cap_moment(0.9), 1e-12);
  EXPECT_NEAR(cut.moment[1], cap_moment(0.75) - cap_moment(0.7), 1e-12);
}

/// Wedges and corners with their edge or tip in the centre, of any angle.
TEST(CellInBall, WedgesAndCorners)
{
  for (const double angle : {0.3, 1.2, 2.0, 2.9})
    {
      // Two planes at this angle through the z axis: its share of the ball.
      const auto edges =
        dealii::Tensor<2, 3>({{30, 0, 0}, {30 * std::cos(angle), 30 * std::sin(angle), 0}, {0, 0, 4}});
      EXPECT_NEAR(volume_in_ball<3>(parallelepiped({0., 0., -2.}, edges), {}, 1.), 2 * angle / 3, 1e-12);
      // Three: the solid angle of the tip (Van Oosterom and Strackee 1983).
      const dealii::Tensor<1, 3> a = edges[0] / 30., b = edges[1] / 30., c({0.3, -0.4, std::sqrt(0.75)});
      const double               solid_angle =
        2 * std::atan2(std::abs(a * cross_product_3d(b, c)), 1 + a * b + b * c + c * a);
      dealii::Tensor<2, 3> tip;
      tip[0] = 30. * a;
      tip[1] = 30. * b;
      tip[2] = 30. * c;
      EXPECT_NEAR(volume_in_ball<3>(parallelepiped({}, tip), {}, 1.), solid_angle / 3, 1e-12) << angle;
    }
}

/// Slanted and distorted cells, with plane faces and warped ones.
TEST(CellInBall, CellsOfMeshesTile)
{
  for (const double distortion : {0., 0.1, 0.3})
    {
      const auto squares = test::make_box<2>({8, 9}, {1., 1.1}, distortion);
      const auto cubes   = test::make_box<3>({6, 7, 6}, {1., 1.2, 1.}, distortion);
      for (unsigned int seed = 0; seed < 4; ++seed)
        {
          dealii::Point<3> centre(0.5, 0.6, 0.5);
          for (int d = 0; d < 3; ++d)
            centre[d] += 0.02 * seed * test::scatter(centre, 10 * seed + d);
          expect_whole_ball<3>(*cubes, centre, 0.4);
          expect_whole_ball<2>(*squares, {centre[0], 0.55}, 0.4);
        }
    }
}

TEST(CellInBall, CellsOfReadMeshesTile)
{
  const auto plate = read_mesh<2>("meshes/plate_unstructured.msh");
  expect_whole_ball<2>(*plate, {0.28, 0.03}, 0.17);
  const auto block = read_mesh<3>("meshes/block.msh");
  expect_whole_ball<3>(*block, {1.02, 0.48, 0.51}, 0.45);
}
