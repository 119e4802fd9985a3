// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/solvers/preconditioner_choice.h>

#include "testing.h"

using namespace perideal;

namespace
{
  /// A square or cube of n cells a side with families of a horizon factor of 3.01.
  SolveSize block(const unsigned int dim, const double n, const bool refined)
  {
    SolveSize size;
    size.dim                = dim;
    size.cells              = std::pow(n, dim);
    size.bonds              = (dim == 2 ? 14. : 61.) * size.cells;
    size.parents            = refined ? std::pow(n / 2, dim) : 0.;
    size.length_in_horizons = n / 3.01;
    return size;
  }

  std::string chosen(const SolveSize &size, const SolverParameters &parameters = {})
  {
    const auto choice = choose_preconditioner(parameters, size);
    return name_of(choice.preconditioner) +
           (choice.auxiliary_mesh ? ", " + name_of(*choice.auxiliary_mesh) : "");
  }
} // namespace

// The decisions that measured times call for (one core, energy form, in the
// order of the lines, ms: block Jacobi, auxiliary on the same, on the parent mesh):
// 33 / 46 / 26, 934 / 439 / 260, 94 / 538 / 148, 766 / 2100 / 720.
TEST(PreconditionerChoice, TakesTheLesserWork)
{
  EXPECT_EQ(chosen(block(2, 32, false)), "block jacobi");
  EXPECT_EQ(chosen(block(2, 175, false)), "auxiliary, same");
  EXPECT_EQ(chosen(block(2, 175, true)), "auxiliary, parent");
  EXPECT_EQ(chosen(block(3, 20, false)), "block jacobi");
  EXPECT_EQ(chosen(block(3, 20, true)), "block jacobi");
  EXPECT_EQ(chosen(block(3, 32, false)), "block jacobi");
  EXPECT_EQ(chosen(block(3, 56, false)), "block jacobi");
  EXPECT_EQ(chosen(block(3, 56, true)), "auxiliary, parent");
}

TEST(PreconditionerChoice, SlenderBodiesTakeTheAuxiliarySpace)
{
  // A plate of 64 x 64 x 4 cells, and a cube of as many.
  SolveSize plate          = block(3, 25.4, false);
  plate.length_in_horizons = 64 / 3.01;
  EXPECT_EQ(chosen(block(3, 25.4, false)), "block jacobi");
  EXPECT_EQ(chosen(plate), "block jacobi");
  plate.length_in_horizons = 400 / 3.01;
  EXPECT_EQ(chosen(plate), "auxiliary, same");
}

TEST(PreconditionerChoice, ManySolvesPayForADearSetUp)
{
  SolverParameters parameters;
  EXPECT_EQ(chosen(block(3, 40, false), parameters), "block jacobi");
  parameters.load_steps = 50;
  EXPECT_EQ(chosen(block(3, 40, false), parameters), "auxiliary, same");
}

TEST(PreconditionerChoice, GmresDislikesManyIterations)
{
  SolveSize size = block(2, 32, false);
  EXPECT_EQ(chosen(size), "block jacobi");
  size.symmetric = false;
  EXPECT_EQ(chosen(size), "auxiliary, same");
}

/// What a bond takes counts the more, the more iterations there are.
TEST(PreconditionerChoice, DearBondsWantFewIterations)
{
  SolveSize size     = block(2, 44, false);
  size.jacobi_factor = size.auxiliary_factor = 2.4;
  EXPECT_EQ(chosen(size), "block jacobi");
  size.bond_factor = 1.7;
  EXPECT_EQ(chosen(size), "auxiliary, same");
}

TEST(PreconditionerChoice, EstimatesIterations)
{
  // Measured: 149 (square), 63 (cube), 268 (a square pulled and sheared).
  EXPECT_NEAR(estimate_block_jacobi(block(2, 100, false), 1e-8).iterations, 183, 1);
  EXPECT_NEAR(estimate_block_jacobi(block(3, 32, false), 1e-8).iterations, 58, 1);
  EXPECT_NEAR(estimate_block_jacobi(block(3, 32, false), 1e-4).iterations, 29, 1);
  EXPECT_NEAR(estimate_auxiliary(block(3, 32, false), AuxiliaryMesh::same, 1e-8).iterations, 25, 1);
  SolveSize harder     = block(3, 32, false);
  harder.jacobi_factor = harder.auxiliary_factor = 2;
  EXPECT_NEAR(estimate_block_jacobi(harder, 1e-8).iterations, 117, 1);
  EXPECT_NEAR(estimate_auxiliary(harder, AuxiliaryMesh::same, 1e-8).iterations, 50, 1);
}

TEST(PreconditionerChoice, SaysWhy)
{
  EXPECT_EQ(choose_preconditioner({}, block(2, 200, true)).reason,
            "estimated 25 iterations; block jacobi would take about 365 and 4.8 times the work");
  EXPECT_EQ(choose_preconditioner({}, block(3, 20, false)).reason,
            "estimated 37 iterations; the auxiliary space would take about 25 but 4.6 times the work");
}

TEST(PreconditionerChoice, ObeysTheParameters)
{
  const SolveSize  square = block(2, 32, false), refined = block(2, 32, true);
  SolverParameters parameters;
  for (const auto name : {PreconditionerName::none, PreconditionerName::block_jacobi})
    {
      parameters.preconditioner = name;
      EXPECT_EQ(chosen(refined, parameters), name_of(name));
      EXPECT_TRUE(choose_preconditioner(parameters, refined).reason.empty());
    }
  parameters.preconditioner = PreconditionerName::auxiliary;
  EXPECT_EQ(chosen(square, parameters), "auxiliary, same");
  EXPECT_EQ(chosen(refined, parameters), "auxiliary, parent");
  parameters.auxiliary_mesh = AuxiliaryMesh::same;
  EXPECT_EQ(chosen(refined, parameters), "auxiliary, same");
  parameters.auxiliary_mesh = AuxiliaryMesh::parent;
  EXPECT_EQ(chosen(refined, parameters), "auxiliary, parent");
  test::expect_input_error([&] { chosen(square, parameters); },
                           {"Solver/Auxiliary mesh", "parent", "not refined", "Mesh/Refinements"});
}

TEST(PreconditionerChoice, AssembledSolversTakeNoAuxiliarySpace)
{
  SolverParameters parameters;
  parameters.linear_solver = LinearSolverName::trilinos_cg;
  for (const auto name :
       {PreconditionerName::automatic, PreconditionerName::auxiliary, PreconditionerName::block_jacobi})
    {
      parameters.preconditioner = name;
      EXPECT_EQ(chosen(block(2, 200, true), parameters), "block jacobi");
    }
  parameters.preconditioner = PreconditionerName::none;
  EXPECT_EQ(chosen(block(2, 200, true), parameters), "none");
  parameters.preconditioner = PreconditionerName::automatic;
  parameters.linear_solver  = LinearSolverName::direct;
  EXPECT_EQ(chosen(block(2, 200, true), parameters), "none");
}
