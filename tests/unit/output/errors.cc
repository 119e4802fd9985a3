// SPDX-License-Identifier: LGPL-2.1-or-later
#include "output_test.h"

#include <perideal/output/errors.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace perideal;
using namespace output_test;

namespace
{
  using Field = std::vector<dealii::Tensor<1, 2>>;

  dealii::Tensor<1, 2> vector(const double x, const double y)
  {
    dealii::Tensor<1, 2> result;
    result[0] = x;
    result[1] = y;
    return result;
  }

  /// A unit square with its right half refined: 8 cells of 1/16, 2 of 1/4.
  /// Reference (3, 4) and error (1, 0) left, reference (0, 1) and error (0, 2) right.
  class TwoHalves : public testing::Test
  {
  protected:
    TwoHalves()
      : mesh(MPI_COMM_WORLD)
      , nodes(make_nodes(mesh))
    {
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        {
          const bool left = nodes.position[i][0] < 0.5;
          reference.push_back(left ? vector(3, 4) : vector(0, 1));
          field.push_back(reference[i] + (left ? vector(1, 0) : vector(0, -2)));
          all.push_back(i);
          if (left)
            left_half.push_back(i);
        }
    }

    static Nodes<2> make_nodes(Mesh<2> &mesh)
    {
      dealii::GridGenerator::subdivided_hyper_cube(mesh.triangulation, 2);
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->center()[0] > 0.5)
          cell->set_refine_flag();
      mesh.triangulation.execute_coarsening_and_refinement();
      return Nodes<2>(mesh, NodeParameters());
    }

    Mesh<2>                 mesh;
    Nodes<2>                nodes;
    Field                   reference, field;
    std::vector<LocalIndex> all, left_half;
  };
} // namespace

TEST_F(TwoHalves, FieldErrorsLeaveOutWhatIsGiven)
{
  // Of the nodes that are no data: those with an error of 2 where the reference is 1, or of 1 where it is 5.
  for (const double expected : {1., 5.})
    {
      const auto errors = field_errors(nodes, field, reference, [&](const LocalIndex i) {
        return std::abs(reference[i].norm() - expected) > 1e-12;
      });
      EXPECT_NEAR(errors.l2, expected == 1. ? 2. : 1. / 5, 1e-14);
    }
}

TEST_F(TwoHalves, FieldErrorsWeighVolumes)
{
  const auto errors = field_errors(nodes, field, reference);
  // Halves of equal volume, although eight nodes stand against two:
  // (1/2 1 + 1/2 4) / (1/2 25 + 1/2 1); round-off of ten summands.
  EXPECT_NEAR(errors.l2, std::sqrt(2.5 / 13), 1e-14);
  EXPECT_NEAR(errors.max, 2. / 5, 1e-14);
}

TEST_F(TwoHalves, ProfileErrorsGoByComponentAndSelection)
{
  auto errors = profile_errors(nodes, all, field, reference);
  EXPECT_NEAR(errors[0], 1. / 3, 1e-14);
  EXPECT_NEAR(errors[1], 2. / 4, 1e-14);
  errors = profile_errors(nodes, left_half, field, reference);
  EXPECT_NEAR(errors[0], 1. / 3, 1e-14);
  EXPECT_EQ(errors[1], 0);
}

TEST_F(TwoHalves, ANaNIsNeverLost)
{
  // One component of one node of the last rank that has any.
  const GlobalIndex last = nodes.n_global - 1;
  if (last >= nodes.first_global && last < nodes.first_global + nodes.size())
    field[last - nodes.first_global][1] = std::numeric_limits<double>::quiet_NaN();
  const auto errors = field_errors(nodes, field, reference);
  EXPECT_FALSE(std::isfinite(errors.l2));
  EXPECT_FALSE(std::isfinite(errors.max));
  const auto profile = profile_errors(nodes, all, field, reference);
  EXPECT_NEAR(profile[0], 1. / 3, 1e-14);
  EXPECT_FALSE(std::isfinite(profile[1]));
}

TEST_F(TwoHalves, WithoutAReferenceThereIsNoRelativeError)
{
  const Field zero(nodes.size());
  EXPECT_TRUE(std::isnan(field_errors(nodes, zero, zero).l2));
  EXPECT_TRUE(std::isnan(field_errors(nodes, zero, zero).max));
  EXPECT_TRUE(std::isinf(field_errors(nodes, field, zero).l2));
}
