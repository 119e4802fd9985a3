// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/solvers/controlled_newton.h>

#include "newton_body.h"
#include "testing.h"

using namespace perideal;
using namespace perideal::test;

namespace
{
  const std::vector<Variant> models = {{"bond based", "energy"}, {"extended ordinary", "energy"}};

  /// A bar of 24 x 3 cells that is pulled, with a solver of its load factor.
  struct ControlledBar
  {
    explicit ControlledBar(const Variant                   &variant,
                           const bool                       by_gauge,
                           const NewtonSolver<2>::Controls &controls)
      : mesh(make_box<2>({24, 3}, {24., 3.}, 0.))
      , body(*mesh, variant, {condition("0", {"0", "0"}), condition("1", {"t", "0"})}, controls)
    {
      ControlledNewton<2>::Control control;
      control.loads_at   = [](const double, NodalVector &force) { force = 0.; };
      control.small_time = 1e-3;
      control.large_time = by_gauge ? 1. : 0.02;
      if (by_gauge)
        control.gauge = [this](const NodalVector &displacement) { return elongation(displacement); };
      path = body.make<ControlledNewton<2>>(controls, control);
    }

    /// Mean displacement along x of the nodes right of the middle less that of the others [m].
    double elongation(const NodalVector &displacement) const
    {
      double result = 0;
      for (LocalIndex i = 0; i < body.body.nodes.size(); ++i)
        result += (body.body.nodes.position[i][0] > 12. ? 1. : -1.) * displacement.local_element(2 * i) / 36.;
      return dealii::Utilities::MPI::sum(result, MPI_COMM_WORLD);
    }

    std::unique_ptr<Mesh<2>>             mesh;
    NewtonBody                           body;
    std::unique_ptr<ControlledNewton<2>> path;
  };
} // namespace

TEST(ControlledNewton, FindsTheLoadsOfAnElongation)
{
  for (const Variant &variant : models)
    {
      SCOPED_TRACE(variant.first);
      ControlledBar bar(variant, true, {1e-8, 25, false});
      for (const double amount : {0.1, 0.3, -0.2})
        {
          const double before = bar.elongation(bar.path->displacement);
          const auto   step   = bar.path->advance(amount, no_newton_progress);
          ASSERT_TRUE(step.converged) << ::testing::PrintToString(step.residuals);
          EXPECT_NEAR(bar.elongation(bar.path->displacement) - before, amount, 1e-3 * std::abs(amount));
          EXPECT_LE(step.iterations, 6u);
        }
      // The same loads lead to the same equilibrium.
      NodalVector difference(bar.path->displacement);
      ASSERT_TRUE(bar.body.newton->step(bar.body.load, bar.path->time(), no_newton_progress).converged);
      difference -= bar.body.newton->displacement;
      EXPECT_LT(difference.linfty_norm(), 1e-6);
    }
}

namespace
{
  /// Lets the bonds across the middle of the bar soften, which gives back more than they take.
  void let_middle_soften(ControlledBar &bar)
  {
    const auto &position = bar.body.body.families->position;
    const auto  stretch  = [&position](const double value) {
      return [&position, value](const LocalIndex i, const LocalIndex j) {
        return (position[i][0] - 12.) * (position[j][0] - 12.) < 0 ? value : 1e6;
      };
    };
    bar.body.bonds->set_critical_stretch(stretch(0.02), SofteningLaw("linear"), stretch(0.0141421));
  }

  /// What a bar dissipates on its path until it is apart [J], and the highest load factor [-].
  struct SnapBack
  {
    double dissipated = 0, highest = 0;
  };

  /// Follows that path by dissipated energy.
  SnapBack follow_snap_back(ControlledBar &bar)
  {
    SnapBack result;
    double   time = 0, amount = 1e-4;
    bar.path->limit_dissipation(amount);
    while (bar.path->load(time + 0.02, no_newton_progress).converged)
      {
        time = bar.path->time();
        result.dissipated += bar.path->amount();
      }
    bar.path->go_back();
    result.highest = time;
    while (amount > 1e-6 && bar.path->energy().strain > 1e-2 * bar.path->energy().external)
      if (bar.path->advance(amount, no_newton_progress).converged)
        {
          amount = std::min(1e-4, 1.5 * amount);
          result.dissipated += bar.path->amount();
          result.highest = std::max(result.highest, bar.path->time());
        }
      else
        {
          bar.path->go_back();
          amount *= 0.5;
        }
    EXPECT_GT(amount, 1e-6);
    return result;
  }
} // namespace

TEST(ControlledNewton, FollowsSnapBackUntilTheBarIsApart)
{
  ControlledBar bar({"bond based", "energy"}, false, {1e-5, 25, true});
  let_middle_soften(bar);
  const SnapBack path = follow_snap_back(bar);
  EXPECT_LT(bar.path->time(), 0.8 * path.highest);
  EXPECT_NEAR(bar.path->energy().dissipated, path.dissipated, 1e-12);
  // Nothing is left but what the trapezoidal rule misses.
  EXPECT_NEAR(path.dissipated, bar.path->energy().external, 0.02 * path.dissipated);
}

TEST(ControlledNewton, JumpsInFewIterations)
{
  for (const Variant &variant : models)
    {
      SCOPED_TRACE(variant.first);
      ControlledBar bar(variant, false, {1e-5, 25, true});
      let_middle_soften(bar);
      bar.path->limit_dissipation(1e-4);
      double time = 0;
      while (bar.path->load(time + 0.02, no_newton_progress).converged)
        time = bar.path->time();
      bar.path->go_back();
      const double before = bar.path->energy().dissipated;
      const auto   step   = bar.path->jump(time + 0.02, no_newton_progress);
      ASSERT_TRUE(step.converged) << ::testing::PrintToString(step.residuals);
      EXPECT_GT(bar.path->energy().dissipated - before, 2e-4);
      // As the crack runs away, steps are gone over again and again; 13 iterations without that.
      EXPECT_LE(step.iterations, 8u);
    }
}

TEST(ControlledNewton, JumpsWhereTheGaugeWouldCloseOnThePath)
{
  for (const Variant &variant : models)
    {
      SCOPED_TRACE(variant.first);
      ControlledBar bar(variant, true, {1e-5, 25, true});
      let_middle_soften(bar);
      constexpr double amount  = 0.01;
      double           highest = 0;
      unsigned int     n_jumps = 0;
      for (unsigned int k = 1; k <= 60; ++k)
        {
          SCOPED_TRACE(k);
          if (!bar.path->advance(amount, no_newton_progress, {8, false}).converged)
            {
              ++n_jumps;
              bar.path->go_back();
              const auto step = bar.path->advance(amount, no_newton_progress, {8, true});
              ASSERT_TRUE(step.converged) << ::testing::PrintToString(step.residuals);
            }
          ASSERT_NEAR(bar.elongation(bar.path->displacement), k * amount, 1e-3 * k * amount);
          highest = std::max(highest, bar.path->energy().strain);
        }
      EXPECT_GE(n_jumps, 1u);
      EXPECT_LT(bar.path->energy().strain, 0.01 * highest);
      // More than on the path, which gives back what the bar stores: the grips may move back less.
      ControlledBar stable(variant, false, {1e-5, 25, true});
      let_middle_soften(stable);
      const double on_path = follow_snap_back(stable).dissipated;
      EXPECT_GT(bar.path->energy().dissipated, on_path);
      EXPECT_LT(bar.path->energy().dissipated, on_path + highest);
    }
}
