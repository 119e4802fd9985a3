// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/reconstruction/family_fit.h>

#include "bodies.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <memory>

using namespace perideal;

namespace
{
  /// A body with its families and a vector for a field on them.
  template <int dim>
  struct FittedBody
  {
    FittedBody(const std::vector<unsigned int> &cells,
               const dealii::Point<dim>        &size,
               const double                     distortion)
      : mesh(test::make_box<dim>(cells, size, distortion))
      , nodes(*mesh, NodeParameters{3.01})
      , families(nodes, nullptr)
      , field(families.make_partitioner(dim))
    {
    }

    /// Sets the field to value(position) at this rank's nodes and their ghosts.
    template <typename Value>
    void set(const Value &value)
    {
      field.zero_out_ghost_values();
      for (LocalIndex i = 0; i < families.n_owned(); ++i)
        for (int d = 0; d < dim; ++d)
          field.local_element(dim * i + d) = value(families.position[i])[d];
      field.update_ghost_values();
    }

    /// Fits through members of the families of which belongs(position of node, of member) holds.
    template <typename Predicate>
    std::vector<dealii::Tensor<2, dim>> fit(const Predicate &belongs) const
    {
      FamilyFit<dim> result(families, field);
      for (LocalIndex i = 0; i < families.n_owned(); ++i)
        for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
          if (belongs(families.position[i], families.position[*j]))
            result.add(i, *j);
      return result.gradients();
    }

    std::unique_ptr<Mesh<dim>> mesh;
    Nodes<dim>                 nodes;
    Families<dim>              families;
    NodalVector                field;
  };

  const auto all = [](const auto &, const auto &) { return true; };

  template <int dim>
  void expect_linear_fields_exact()
  {
    dealii::Tensor<2, dim> gradient;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        gradient[a][b] = 1e-3 * (1 + a - 2 * b);
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    FittedBody<dim> body(std::vector<unsigned int>(dim, 5), size, 0.3);
    body.set([&](const auto &x) { return gradient * x; });
    for (const auto &found : body.fit(all))
      EXPECT_LE((found - gradient).norm(), 1e-13);
  }
} // namespace

TEST(FamilyFit, IsExactForLinearFields)
{
  expect_linear_fields_exact<2>();
  expect_linear_fields_exact<3>();
}

/// A field that jumps at x = 0.5 has the gradient of either side where no bond crosses.
TEST(FamilyFit, SeesOneSideOfACut)
{
  FittedBody<2> body({8, 8}, {1., 1.}, 0.2);
  const auto    is_right = [](const dealii::Point<2> &x) { return x[0] > 0.5; };
  body.set([&](const auto &x) { return dealii::Point<2>(is_right(x) ? 1. + x[1] : x[0], 0.); });
  const auto gradients = body.fit([&](const auto &x, const auto &y) { return is_right(x) == is_right(y); });
  for (LocalIndex i = 0; i < gradients.size(); ++i)
    {
      const bool right = is_right(body.families.position[i]);
      EXPECT_NEAR(gradients[i][0][0], right ? 0. : 1., 1e-12);
      EXPECT_NEAR(gradients[i][0][1], right ? 1. : 0., 1e-12);
    }
}

/// What changes sign from cell to cell is no strain: a jitter of 1 of the spacing, over which a difference
/// of neighbours would see a gradient of 2.
TEST(FamilyFit, AveragesJitterOut)
{
  FittedBody<2> body({12, 12}, {12., 12.}, 0.);
  body.set([](const auto &x) {
    const int sum = static_cast<int>(std::floor(x[0])) + static_cast<int>(std::floor(x[1]));
    return dealii::Point<2>(sum % 2 == 0 ? 0.5 : -0.5, 0.);
  });
  for (const auto &gradient : body.fit(all))
    EXPECT_LE(gradient.norm(), 0.1);
}

/// Across a row of cells, and without members, nothing is known.
TEST(FamilyFit, LeavesUnknownDirectionsAlone)
{
  FittedBody<2> row({9, 1}, {9., 1.}, 0.);
  row.set([](const auto &x) { return dealii::Point<2>(0.1 * x[0], 0.2 * x[0]); });
  for (const auto &gradient : row.fit(all))
    {
      EXPECT_NEAR(gradient[0][0], 0.1, 1e-13);
      EXPECT_NEAR(gradient[1][0], 0.2, 1e-13);
      EXPECT_NEAR(gradient[0][1], 0., 1e-13);
    }
  for (const auto &gradient : row.fit([](const auto &, const auto &) { return false; }))
    EXPECT_EQ(gradient.norm(), 0.);
}
