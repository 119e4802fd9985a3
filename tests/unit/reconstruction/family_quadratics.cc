// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/reconstruction/family_quadratics.h>

#include "bodies.h"

#include <gtest/gtest.h>

using namespace perideal;

namespace
{
  /// A quadratic field u_a = sum_b (g_ab x_b + c_ab x_b^2) + s_a x_0 x_1 and its gradient.
  template <int dim>
  struct Quadratic
  {
    static double coefficient(const int a, const int b) { return 1. + a - 0.7 * b; }

    static dealii::Tensor<1, dim> value(const dealii::Point<dim> &x)
    {
      dealii::Tensor<1, dim> result;
      for (int a = 0; a < dim; ++a)
        {
          result[a] = (a - 0.4) * x[0] * x[1];
          for (int b = 0; b < dim; ++b)
            result[a] += coefficient(a, b) * x[b] + coefficient(b, a) * x[b] * x[b];
        }
      return result;
    }

    static dealii::Tensor<2, dim> gradient(const dealii::Point<dim> &x)
    {
      dealii::Tensor<2, dim> result;
      for (int a = 0; a < dim; ++a)
        {
          result[a][0] = (a - 0.4) * x[1];
          result[a][1] = (a - 0.4) * x[0];
          for (int b = 0; b < dim; ++b)
            result[a][b] += coefficient(a, b) + 2. * coefficient(b, a) * x[b];
        }
      return result;
    }
  };

  /// Of every second node, from members on its side of a plane alone.
  template <int dim>
  void expect_quadratics_exact(const std::vector<unsigned int> &cells, const double distortion)
  {
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    const auto            mesh = test::make_box<dim>(cells, size, distortion);
    const test::Body<dim> body(*mesh);
    const Families<dim>  &families = *body.families;
    NodalVector           field(families.make_partitioner(dim));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (int d = 0; d < dim; ++d)
        field.local_element(dim * i + d) = Quadratic<dim>::value(families.position[i])[d];
    field.update_ghost_values();
    std::vector<LocalIndex> asked;
    for (LocalIndex i = 0; i < families.n_owned(); i += 2)
      asked.push_back(i);
    FamilyQuadratics<dim> fit(families, field, asked);
    const auto            is_left = [&](const LocalIndex i) { return families.position[i][0] < 0.5; };
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
        if (is_left(i) == is_left(*j))
          fit.add(i, *j);
    const auto gradients = fit.gradients();
    ASSERT_EQ(gradients.size(), asked.size());
    for (std::size_t k = 0; k < asked.size(); ++k)
      EXPECT_NEAR((gradients[k] - Quadratic<dim>::gradient(families.position[asked[k]])).norm(), 0., 1e-9);
  }
} // namespace

TEST(FamilyQuadratics, AreExactBesideACrack)
{
  expect_quadratics_exact<2>({12, 10}, 0.);
  expect_quadratics_exact<2>({12, 10}, 0.2);
  expect_quadratics_exact<3>({8, 7, 7}, 0.1);
}

/// A row of nodes tells the change along it, and of what it does not tell nothing is made up.
TEST(FamilyQuadratics, LeaveOutWhatMembersDoNotTell)
{
  const auto          mesh = test::make_box<2>({8, 8}, {1., 1.}, 0.);
  const test::Body<2> body(*mesh);
  const Families<2>  &families = *body.families;
  NodalVector         field(families.make_partitioner(2));
  for (LocalIndex i = 0; i < families.n_owned(); ++i)
    field.local_element(2 * i) = families.position[i][0] + 2. * families.position[i][1];
  field.update_ghost_values();
  std::vector<LocalIndex> asked;
  for (LocalIndex i = 0; i < families.n_owned(); ++i)
    asked.push_back(i);
  FamilyQuadratics<2> fit(families, field, asked);
  for (const LocalIndex i : asked)
    for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
      if (std::abs(families.position[i][1] - families.position[*j][1]) < 1e-9)
        fit.add(i, *j);
  for (const auto &gradient : fit.gradients())
    {
      EXPECT_NEAR(gradient[0][0], 1., 1e-9);
      EXPECT_NEAR(gradient[0][1], 0., 1e-9);
      EXPECT_NEAR(gradient[1].norm(), 0., 1e-12);
    }
}
