// SPDX-License-Identifier: LGPL-2.1-or-later
#include "newton_body.h"
#include "testing.h"

#include <cmath>

using namespace perideal;
using namespace perideal::test;

namespace
{
  const std::vector<Variant> variants = {{"bond based", "energy"},
                                         {"ordinary", "energy"},
                                         {"extended ordinary", "paper"},
                                         {"extended ordinary", "energy"}};

  /// The exponent of convergence: of the last three residuals above a bound.
  double exponent(const std::vector<double> &residuals, const double bound)
  {
    std::size_t n = residuals.size();
    while (n > 0 && residuals[n - 1] < bound)
      --n;
    EXPECT_GE(n, 3u);
    return n < 3 ?
             0. :
             std::log(residuals[n - 1] / residuals[n - 2]) / std::log(residuals[n - 2] / residuals[n - 3]);
  }

  const auto clamped = [] { return condition("0", {"0", "0"}); };

  TEST(Newton, ConvergesQuadratically)
  {
    const auto mesh = test::make_box<2>({12, 6}, {2., 1.}, 0.1);
    for (const Variant &variant : variants)
      {
        SCOPED_TRACE(variant.first + ", " + variant.second);
        NewtonBody body(*mesh, variant, {clamped(), condition("1", {"0.4*t", "0.2*t"})}, {1e-12, 25, false});
        const EquilibriumStep step = body.newton->step(body.load, 1., no_newton_progress);
        EXPECT_TRUE(step.converged) << step.problem;
        // Below 1e-10, the single precision of the force, 6e-8 of the tangent, makes it linear.
        EXPECT_GE(exponent(step.residuals, 1e-10), 1.7) << ::testing::PrintToString(step.residuals);
      }
  }

  TEST(Newton, TakesSixIterationsToTenPerCent)
  {
    const auto mesh = test::make_box<2>({12, 6}, {2., 1.}, 0.1);
    for (const Variant &variant : variants)
      for (const std::string stretch : {"2e-3*t", "0.2*t"})
        {
          SCOPED_TRACE(variant.first + ", " + variant.second + ", " + stretch);
          NewtonBody            body(*mesh, variant, {clamped(), condition("1", {stretch, "0"})});
          const EquilibriumStep step = body.newton->step(body.load, 1., no_newton_progress);
          EXPECT_TRUE(step.converged) << step.problem;
          EXPECT_LE(step.iterations, 6u) << ::testing::PrintToString(step.residuals);
          // A further step with nothing new.
          EXPECT_EQ(body.newton->step(body.load, 1., no_newton_progress).iterations, 0u);
          // The work that went in is the strain energy, but for the trapezoidal rule along a path that
          // is nearly straight.
          if (variant.second == "energy")
            {
              EXPECT_NEAR(body.newton->energy().external,
                          body.newton->energy().strain,
                          0.02 * body.newton->energy().strain);
            }
        }
  }

  TEST(Newton, SameEquilibriumInSmallSteps)
  {
    const auto mesh = test::make_box<2>({12, 6}, {2., 1.}, 0.1);
    for (const Variant &variant : variants)
      {
        SCOPED_TRACE(variant.first + ", " + variant.second);
        const std::vector<BoundaryConditionText> conditions = {clamped(), condition("1", {"0.2*t", "0.1*t"})};
        NewtonBody                               at_once(*mesh, variant, conditions);
        NewtonBody                               slowly(*mesh, variant, conditions);
        EXPECT_TRUE(at_once.newton->step(at_once.load, 1., no_newton_progress).converged);
        for (unsigned int n = 1; n <= 5; ++n)
          EXPECT_TRUE(slowly.newton->step(slowly.load, 0.2 * n, no_newton_progress).converged);
        at_once.newton->displacement -= slowly.newton->displacement;
        // The residual of 1e-8 times the ratio of the slowest to the fastest motion, some 100.
        EXPECT_LT(at_once.newton->displacement.l2_norm(), 1e-6 * slowly.newton->displacement.l2_norm());
      }
  }

  /// The state to which whole steps come in 25 iterations, or zero where they come to none.
  NodalVector by_whole_steps(NewtonBody &body)
  {
    NodalVector displacement(body.load), force(body.load), residual(body.load), correction(body.load);
    displacement = 0.;
    for (unsigned int n = 0; n <= 25; ++n)
      {
        body.bonds->compute(force, displacement);
        for (std::size_t k = 0; k < residual.locally_owned_size(); ++k)
          residual.local_element(k) =
            body.held.mask()[k] ? 0. : body.load.local_element(k) + force.local_element(k);
        if (residual.l2_norm() < 1e-8 * body.load.l2_norm())
          return displacement;
        body.tangent->linearise(*body.bonds);
        correction = 0.;
        if (!body.linear->solve(correction, residual, 1e-10).converged)
          break;
        displacement += correction;
      }
    displacement = 0.;
    return displacement;
  }

  TEST(Newton, LineSearchBendsFar)
  {
    const auto   mesh     = test::make_box<2>({48, 4}, {12., 1.}, 0.);
    unsigned int n_astray = 0;
    for (const double force : {6e-4, 1e-3, 1.5e-3, 2e-3, 3e-3})
      {
        SCOPED_TRACE(force);
        NewtonBody at_once(*mesh, variants[0], {clamped()});
        at_once.push(force);
        const EquilibriumStep step = at_once.newton->step(at_once.load, 1., no_newton_progress);
        EXPECT_TRUE(step.converged) << step.problem << ::testing::PrintToString(step.residuals);

        NewtonBody slowly(*mesh, variants[0], {clamped()});
        for (unsigned int n = 1; n <= 20; ++n)
          {
            slowly.push(0.05 * n * force);
            EXPECT_TRUE(slowly.newton->step(slowly.load, 0.05 * n, no_newton_progress).converged);
          }
        const NodalVector &right  = slowly.newton->displacement;
        NodalVector        whole  = by_whole_steps(at_once);
        NodalVector        search = at_once.newton->displacement;
        // Its end hangs by more than half its length.
        EXPECT_GT(right.linfty_norm(), 6.);
        search -= right;
        whole -= right;
        // The residual of 1e-8 bends the body, 1000 times as soft as its cells, by less.
        EXPECT_LT(search.l2_norm(), 1e-5 * right.l2_norm());
        n_astray += whole.l2_norm() > 1e-2 * right.l2_norm();
      }
    EXPECT_GT(n_astray, 0u);
  }

  TEST(Newton, TriesGmresWhereCgFails)
  {
    // Compressed to a half, the tangent is far from the body at rest, which the preconditioner is of: CG
    // takes 148 iterations, GMRES, with a preconditioner of its own, 99.
    const auto mesh = test::make_box<2>({12, 6}, {2., 1.}, 0.1);
    NewtonBody body(*mesh, variants[0], {clamped()});
    body.parameters.max_iterations = 120;
    TangentSolver<2> linear(body.parameters, [&](const SolverParameters &solver) {
      return create_linear_solver<2>(
        solver, {PreconditionerName::block_jacobi, {}, ""}, *body.system, body.null_space, nullptr);
    });
    NodalVector      displacement(body.load), source(body.load), solution(body.load), residual(body.load);
    for (LocalIndex i = 0; i < body.body.nodes.size(); ++i)
      {
        displacement.local_element(2 * i) = -0.5 * body.body.nodes.position[i][0];
        if (!body.held.mask()[2 * i + 1])
          source.local_element(2 * i + 1) = test::scatter(body.body.nodes.position[i], 3);
      }
    body.bonds->compute(residual, displacement);
    body.tangent->linearise(*body.bonds);
    const LinearSolve solving = linear.solve(solution, source, 1e-8);
    EXPECT_TRUE(solving.converged);
    EXPECT_GT(solving.iterations, 120u);
    body.system->vmult(residual, solution);
    residual -= source;
    EXPECT_LT(residual.l2_norm(), 2e-8 * source.l2_norm());
  }

  TEST(Newton, ReportsFailure)
  {
    const auto mesh = test::make_box<2>({8, 4}, {2., 1.}, 0.);
    NewtonBody body(*mesh, variants[0], {clamped(), condition("1", {"0.2*t", "0"})}, {1e-8, 1, false});
    const EquilibriumStep step = body.newton->step(body.load, 1., no_newton_progress);
    EXPECT_FALSE(step.converged);
    EXPECT_EQ(step.iterations, 1u);
    // Nothing holds it along y.
    NewtonBody loose(*mesh, variants[0], {condition("0", {"0"})});
    loose.push(1e-3);
    EXPECT_FALSE(loose.newton->step(loose.load, 1., no_newton_progress).converged);
  }
} // namespace
