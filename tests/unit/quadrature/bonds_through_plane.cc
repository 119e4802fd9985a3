// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/quadrature/bonds_through_plane.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;
using dealii::numbers::PI;

namespace
{
  template <int dim>
  using Rule = BondsThroughPlane<dim>;

  /// A normal along no axis.
  template <int dim>
  dealii::Tensor<1, dim> skew_normal()
  {
    dealii::Tensor<1, dim> n;
    for (int d = 0; d < dim; ++d)
      n[d] = 1. + 0.7 * d;
    return n / n.norm();
  }

  template <int dim, typename Function>
  auto sum(const std::vector<typename Rule<dim>::Fan> &fans, const Function &function)
  {
    decltype(function(dealii::Tensor<1, dim>())) result{};
    for (const auto &fan : fans)
      for (std::size_t b = 0; b < fan.bond.size(); ++b)
        result += fan.weight[b] * function(fan.bond[b]);
    return result;
  }

  /// Forces that are cubic in the direction of bonds, as those of a uniform strain: in closed form
  /// 1/2 int xi_i xi_j xi_k xi_l/|xi|^2 dV n_l = M (d_ij d_kl + d_ik d_jl + d_il d_jk) n_l.
  template <int dim>
  void expect_fourth_moments()
  {
    const double horizon = 1.7;
    const double m = 0.5 * (dim == 3 ? PI * std::pow(horizon, 4) / 15. : PI * std::pow(horizon, 3) / 12.);
    const auto   n = skew_normal<dim>();
    const auto   fans =
      Rule<dim>::find(dealii::Point<dim>(), n, horizon, BodyRays<dim>(), Rule<dim>::Orders::smooth());
    const auto delta = [](const int a, const int b) { return a == b ? 1. : 0.; };
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j)
        for (int k = 0; k < dim; ++k)
          {
            const double expected = m * (delta(i, j) * n[k] + delta(i, k) * n[j] + delta(j, k) * n[i]);
            const double read     = sum<dim>(fans, [&](const dealii::Tensor<1, dim> &xi) {
              return xi[i] * xi[j] * xi[k] / std::pow(xi.norm(), 3);
            });
            // Round-off.
            EXPECT_NEAR(read, expected, 1e-13 * m) << dim << "-D: " << i << j << k;
          }
  }

  /// A large face with an outward normal along x.
  template <int dim>
  BodyRays<dim> face_at(const double x)
  {
    std::vector<dealii::Point<dim>> vertices;
    for (int v = 0; v < (dim == 3 ? 4 : 2); ++v)
      {
        dealii::Point<dim> vertex;
        vertex[0]       = x;
        vertex[1]       = v % 2 == 0 ? -10. : 10.;
        vertex[dim - 1] = dim == 2 ? vertex[1] : v / 2 == 0 ? -10. : 10.;
        vertices.push_back(vertex);
      }
    dealii::Tensor<1, dim> outward;
    outward[0] = 1.;
    BodyRays<dim> result;
    result.add_face(vertices, outward);
    return result;
  }

  template <int dim>
  double measure(const dealii::Tensor<1, dim> &n, const BodyRays<dim> &body)
  {
    return sum<dim>(Rule<dim>::find(dealii::Point<dim>(), n, 1., body, Rule<dim>::Orders::cut()),
                    [](const dealii::Tensor<1, dim> &xi) { return 1. / std::pow(xi.norm(), dim - 1); });
  }

  template <int dim>
  void expect_nothing_outside()
  {
    dealii::Tensor<1, dim> n;
    n[0] = 1.;
    // No matter behind the plane; then no line.
    EXPECT_EQ(measure<dim>(n, face_at<dim>(0.)), 0.);
    EXPECT_EQ(measure<dim>(-n, face_at<dim>(0.)), 0.);
    // Along the face one half of the bonds is there, up to directions in the face itself.
    dealii::Tensor<1, dim> along;
    along[1] = 1.;
    EXPECT_NEAR(measure<dim>(along, face_at<dim>(0.)),
                0.5 * measure<dim>(along, BodyRays<dim>()),
                (dim == 2 ? 1e-12 : 0.05) * measure<dim>(along, BodyRays<dim>()));
  }
} // namespace

TEST(BondsThroughPlane, HasTheMomentsOfAHalfSphere)
{
  expect_fourth_moments<2>();
  expect_fourth_moments<3>();
}

TEST(BondsThroughPlane, EndsAtAFace)
{
  // Of each direction of cosine mu the triangle s < r mu < mu is cut at r mu - s = a, which leaves
  // a - a^2/(2 mu) where mu > a, else mu/2.
  dealii::Tensor<1, 3> n;
  n[0] = 1.;
  for (const double a : {0.1, 0.4, 0.8})
    {
      const double expected = 2. * PI * (a - 0.75 * a * a + 0.5 * a * a * std::log(a));
      // Directions and lines have kinks where the face begins to cut bonds.
      EXPECT_NEAR(measure<3>(n, face_at<3>(a)), expected, 2e-3 * expected) << a;
    }
  EXPECT_NEAR(measure<3>(n, face_at<3>(2.)), PI / 2., 1e-13);
}

TEST(BondsThroughPlane, FindsNothingOutsideTheBody)
{
  expect_nothing_outside<2>();
  expect_nothing_outside<3>();
}

TEST(BodyRays, GoOnBehindAHole)
{
  // A line leaves at 1, enters at 2 and leaves at 3; faces that share an edge are met twice there.
  BodyRays<2>                body;
  const dealii::Tensor<1, 2> right({1., 0.});
  body.add_face({{1., -1.}, {1., 0.}}, right);
  body.add_face({{1., 0.}, {1., 1.}}, right);
  body.add_face({{2., -1.}, {2., 1.}}, -right);
  body.add_face({{3., -1.}, {3., 1.}}, right);
  const auto parts = body.parts_inside(dealii::Point<2>(), right, 5.);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_NEAR(parts[0].first, 0., 1e-15);
  EXPECT_NEAR(parts[0].second, 1., 1e-15);
  EXPECT_NEAR(parts[1].first, 2., 1e-15);
  EXPECT_NEAR(parts[1].second, 3., 1e-15);
  EXPECT_EQ(body.parts_inside(dealii::Point<2>(), -right, 5.).size(), 1u);
}
