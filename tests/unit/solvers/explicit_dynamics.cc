// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/solvers/explicit_dynamics.h>
#include <perideal/treatments/treatments.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>
#include <map>

using namespace perideal;

namespace
{
  /// A body of unit modulus and density, free or held.
  struct MovingBody
  {
    MovingBody(const Mesh<2>        &mesh,
               const std::string    &model,
               const LoadParameters &text,
               const double          horizon)
      : body(mesh, horizon)
      , loads(resolve_boundaries(mesh, Loads<2>(text)))
      , held(find_boundary_faces(mesh, body.nodes), loads, body.nodes.size())
      , mass(body.nodes.volume)
    {
      ModelParameters parameters;
      parameters.model = model;
      parameters.form  = "energy";
      parameters.resolve(2);
      const ElasticConstants constants =
        parameters.constants_of_model({1., 0.3, PlaneAssumption::plane_stress});
      const auto solid_of = [&](const dealii::types::material_id) { return ElasticSolid<2>(constants); };
      bonds =
        create_bond_force<2>(*weigh_bonds<2>(body.families, *create_model<2>(parameters, 1.), solid_of));
      bonds->initialize(no_load);
    }

    ExplicitDynamics<2>
    dynamics(const double                     time_step,
             const ExplicitDynamics<2>::Start start   = ExplicitDynamics<2>::Start::velocity_verlet,
             const double                     damping = 0)
    {
      return ExplicitDynamics<2>(*bonds, held, loads, mass, damping, time_step, start);
    }

    test::Body<2>                 body;
    Loads<2>                      loads;
    DirichletNodes<2>             held;
    std::vector<double>           mass;
    std::unique_ptr<BondForce<2>> bonds;
    NodalVector                   no_load;
  };
} // namespace

/// Two nodes and a spring: central differences have a closed solution,
/// x_n = v/(w sqrt(1 - (w dt/2)^2)) sin(n 2 asin(w dt/2)).
TEST(ExplicitDynamics, OscillatesAsTwoNodesDo)
{
  const auto   mesh = test::make_box<2>({2, 1}, {2., 1.}, 0.);
  MovingBody   moving(*mesh, "bond based", {}, 1.5);
  const double dt = 0.3, v = 1e-2;

  // The spring: the force of a stretched pair.
  auto probe                          = moving.dynamics(dt);
  probe.displacement.local_element(0) = -0.5e-2;
  probe.displacement.local_element(2) = 0.5e-2;
  NodalVector force(probe.displacement);
  moving.bonds->compute(force, probe.displacement);
  const double w = std::sqrt(2 * force.local_element(0) / 1e-2);
  ASSERT_GT(w, 0.5);

  auto dynamics                      = moving.dynamics(dt);
  dynamics.velocity.local_element(0) = -0.5 * v;
  dynamics.velocity.local_element(2) = 0.5 * v;
  const double half_angle            = std::asin(0.5 * w * dt);
  for (unsigned int n = 0; n < 1000; ++n)
    {
      dynamics.evaluate(moving.no_load);
      const double stretch = dynamics.displacement.local_element(2) - dynamics.displacement.local_element(0);
      ASSERT_NEAR(stretch, v / (w * std::cos(half_angle)) * std::sin(2 * n * half_angle), 1e-12) << n;
      dynamics.advance();
    }
}

/// Where steps are divided the velocities of half a step before become those of half a new one: the energy of
/// leapfrog is then, to second order, what it was.
TEST(ExplicitDynamics, DividesItsSteps)
{
  using Start     = ExplicitDynamics<2>::Start;
  const auto mesh = test::make_box<2>({5, 4}, {1., 0.8}, 0.1);
  const auto jump = [&](const double dt) {
    MovingBody moving(*mesh, "bond based", {}, 3.01);
    auto       before = moving.dynamics(dt);
    for (LocalIndex i = 0; i < moving.body.nodes.size(); ++i)
      for (int d = 0; d < 2; ++d)
        before.velocity.local_element(2 * i + d) = 3e-4 * test::scatter(moving.body.nodes.position[i], d);
    const auto energy = [](const ExplicitDynamics<2> &dynamics) {
      return dynamics.energy().kinetic + dynamics.energy().strain;
    };
    for (double t = 0; t < 0.5; t += dt)
      {
        before.evaluate(moving.no_load);
        before.advance();
      }
    auto after         = moving.dynamics(dt / 4., Start::symplectic_euler);
    after.displacement = before.displacement;
    after.velocity     = before.velocity;
    after.divide_steps(4);
    before.evaluate(moving.no_load);
    const double of_before = energy(before);
    after.evaluate(moving.no_load);
    return std::abs(energy(after) / of_before - 1.);
  };
  const double coarse = jump(0.02), fine = jump(0.01);
  EXPECT_LE(coarse, 1e-3);
  EXPECT_LE(fine, 0.35 * coarse);
}

/// A free body that vibrates for 100,000 steps keeps its energy, momentum and angular momentum.
TEST(ExplicitDynamics, ConservesOverManySteps)
{
  for (const std::string model : {"bond based", "extended ordinary"})
    {
      const auto mesh = test::make_box<2>({5, 4}, {1., 0.8}, 0.1);
      MovingBody moving(*mesh, model, {}, 3.01);
      auto       dynamics = moving.dynamics(0.02);
      for (LocalIndex i = 0; i < moving.body.nodes.size(); ++i)
        for (int d = 0; d < 2; ++d)
          dynamics.velocity.local_element(2 * i + d) = 3e-4 * test::scatter(moving.body.nodes.position[i], d);

      const auto momenta = [&]() {
        dealii::Tensor<1, 3> result;
        for (LocalIndex i = 0; i < moving.body.nodes.size(); ++i)
          {
            const double m = moving.mass[i];
            double       v[2], y[2];
            for (int d = 0; d < 2; ++d)
              {
                v[d] = dynamics.velocity.local_element(2 * i + d);
                y[d] = moving.body.nodes.position[i][d] + dynamics.displacement.local_element(2 * i + d);
              }
            result[0] += m * v[0];
            result[1] += m * v[1];
            result[2] += m * (y[0] * v[1] - y[1] * v[0]);
          }
        return result;
      };
      dealii::Tensor<1, 3> first_momenta;
      double               scale = 0, early = 0, late = 0;
      const unsigned int   n_steps = 100000;
      for (unsigned int n = 0; n <= n_steps; ++n)
        {
          dynamics.evaluate(moving.no_load);
          if (n == 0)
            {
              first_momenta = momenta();
              scale         = dynamics.energy().external;
            }
          if (n % 10 == 0)
            {
              double &worst = n < n_steps / 2 ? early : late;
              worst         = std::max(worst, std::abs(dynamics.energy().imbalance()) / scale);
            }
          dynamics.advance();
        }
      EXPECT_LE((momenta() - first_momenta).norm(), 1e-12 * 3e-4) << model;
      EXPECT_LE(late, 1e-6) << model;
      EXPECT_LE(late, 2 * early) << model;
    }
}

/// A wave runs along a thin bar at sqrt(E/rho).
TEST(ExplicitDynamics, SendsWavesAtTheirSpeed)
{
  const auto            mesh = test::make_box<2>({200, 4}, {200., 4.}, 0.);
  LoadParameters        text;
  BoundaryConditionText push;
  push.name = push.boundary = "0";
  push.velocity[0]          = "1e-4*min(t/10, 1)";
  text.conditions           = {push};
  MovingBody moving(*mesh, "extended ordinary", text, 3.01);
  auto       dynamics = moving.dynamics(0.3);
  double     front[2];
  for (const int k : {0, 1})
    {
      const double time = k == 0 ? 60 : 150;
      while (dynamics.time() < time - 1e-9)
        {
          dynamics.evaluate(moving.no_load);
          dynamics.advance();
        }
      // Where the velocity has come to a half, from the far end.
      front[k] = 0;
      for (LocalIndex i = 0; i < moving.body.nodes.size(); ++i)
        if (dynamics.velocity.local_element(2 * i) > 0.5e-4)
          front[k] = std::max(front[k], moving.body.nodes.position[i][0]);
    }
  EXPECT_NEAR((front[1] - front[0]) / 90., 1., 0.02);
}

/// A traction sigma that is there at once moves the end of a bar at sigma/(rho c).
TEST(ExplicitDynamics, PushesABarAtItsSpeed)
{
  const auto            mesh = test::make_box<2>({200, 4}, {200., 4.}, 0.);
  LoadParameters        text;
  BoundaryConditionText push;
  push.name = push.boundary = "0";
  push.traction[0]          = "if(t < 6, 0, 1e-4)";
  text.conditions           = {push};
  MovingBody moving(*mesh, "extended ordinary", text, 3.01);
  ASSERT_TRUE(moving.loads.forces_depend_on_time());
  const auto faces = find_boundary_faces(*mesh, moving.body.nodes);
  Timings    timings(MPI_COMM_WORLD);
  const auto tractions = load_by_layer<2>({*mesh, moving.body.nodes, faces, moving.loads, text, timings}, {});
  auto       dynamics  = moving.dynamics(0.3);
  const auto end       = [&]() {
    double     sum = 0;
    LocalIndex n   = 0;
    for (LocalIndex i = 0; i < moving.body.nodes.size(); ++i)
      if (moving.body.nodes.position[i][0] < 1)
        {
          sum += dynamics.displacement.local_element(2 * i);
          ++n;
        }
    return sum / n;
  };
  NodalVector  force(moving.no_load);
  const double times[] = {5.9, 26, 126};
  double       position[3];
  for (const int k : {0, 1, 2})
    {
      while (dynamics.time() < times[k])
        {
          force = 0.;
          tractions->add_tractions(moving.loads, dynamics.time(), force);
          dynamics.evaluate(force);
          dynamics.advance();
        }
      position[k] = end();
    }
  EXPECT_EQ(position[0], 0.);
  // rho = 1, E = 1: a thin bar's c is 1.
  EXPECT_NEAR((position[2] - position[1]) / 100. / 1e-4, 1., 0.02);
}

/// The work of supports, loads and damping balances what is there.
TEST(ExplicitDynamics, BalancesWorkAndDamping)
{
  const auto            mesh = test::make_box<2>({8, 6}, {1., 0.75}, 0.2);
  LoadParameters        text;
  BoundaryConditionText shake;
  shake.name = shake.boundary = "0";
  shake.displacement[0]       = "1e-3*sin(2*t)";
  shake.velocity[1]           = "1e-3*cos(3*t)";
  text.conditions             = {shake};
  text.body_force[1]          = "-1e-3";
  MovingBody moving(*mesh, "extended ordinary", text, 3.01);
  for (const auto start :
       {ExplicitDynamics<2>::Start::velocity_verlet, ExplicitDynamics<2>::Start::symplectic_euler})
    {
      auto        dynamics = moving.dynamics(0.01, start, 0.5);
      NodalVector weight(moving.no_load);
      for (LocalIndex i = 0; i < moving.body.nodes.size(); ++i)
        weight.local_element(2 * i + 1) = -1e-3 * moving.body.nodes.volume[i];
      double largest = 0;
      for (unsigned int n = 0; n < 2000; ++n)
        {
          dynamics.evaluate(weight);
          const EnergyBudget energy = dynamics.energy();
          largest                   = std::max(largest, energy.kinetic + energy.strain + energy.damped);
          ASSERT_LE(std::abs(energy.imbalance()), 1e-4 * largest + 1e-15) << n;
          dynamics.advance();
        }
      EXPECT_GT(dynamics.energy().damped, 0.1 * largest);
    }
}

/// Short waves are slower: in a row of nodes with constant micromodulus c^2/c0^2 = 4/(k d)^2 times the
/// integral of (1 - cos x)/x from 0 to k d.
TEST(ExplicitDynamics, DispersesWavesAsTheHorizonSays)
{
  const double horizon = 15.; // cells
  const auto   mesh    = test::make_box<2>({1400, 1}, {1400., 1.}, 0.);
  MovingBody   moving(*mesh, "bond based", {}, horizon + 0.01);
  // Of a standing wave, until it is flat for the first time; the ends are too far away to be felt.
  const auto speed = [&](const double kd) {
    const double k        = kd / horizon;
    auto         dynamics = moving.dynamics(0.25);
    LocalIndex   middle   = 0;
    for (LocalIndex i = 0; i < moving.body.nodes.size(); ++i)
      {
        const double x                         = moving.body.nodes.position[i][0] - 700.5;
        dynamics.velocity.local_element(2 * i) = 1e-8 * std::cos(k * x);
        if (std::abs(x) < 0.1)
          middle = i;
      }
    double before = 1;
    while (true)
      {
        dynamics.evaluate(moving.no_load);
        const double now = dynamics.velocity.local_element(2 * middle);
        if (now < 0)
          // Velocities are those of half a step later.
          return dealii::numbers::PI / 2 / (k * 0.25 * (dynamics.step() + 0.5 - now / (now - before)));
        before = now;
        dynamics.advance();
      }
  };
  const double long_wave = speed(0.1) / 0.99979;
  EXPECT_NEAR(speed(0.5) / long_wave, 0.9948, 0.005);
  EXPECT_NEAR(speed(1.) / long_wave, 0.9794, 0.005);
  EXPECT_NEAR(speed(2.) / long_wave, 0.9205, 0.005);
}

/// What is symmetric stays so: displacements until the first bond breaks, the tips of a crack to a cell
/// afterwards.
TEST(ExplicitDynamics, KeepsSymmetry)
{
  for (const std::string model : {"bond based", "extended ordinary"})
    {
      const auto mesh = test::make_box<2>({60, 24}, {60., 24.}, 0.);
      MovingBody moving(*mesh, model, {}, 3.01);
      moving.bonds->cut([](const dealii::Point<2> &a, const dealii::Point<2> &b) {
        return (a[1] - 12.) * (b[1] - 12.) < 0 && std::min(a[0], b[0]) < 30.;
      });
      moving.bonds->set_critical_stretch([](const LocalIndex, const LocalIndex) { return 4e-3; });
      const auto &position = moving.body.nodes.position;
      auto        dynamics = moving.dynamics(0.3);
      for (LocalIndex i = 0; i < position.size(); ++i)
        dynamics.velocity.local_element(2 * i + 1) = 4e-4 * (position[i][1] - 12.);
      std::map<std::pair<int, int>, LocalIndex> at;
      for (LocalIndex i = 0; i < position.size(); ++i)
        at[{std::lround(2 * position[i][0]), std::lround(2 * position[i][1])}] = i;

      for (unsigned int n = 0; n < 600; ++n)
        {
          dynamics.evaluate(moving.no_load);
          if (dynamics.n_broken() == 0)
            {
              double largest = 0, difference = 0;
              for (const auto &[where, i] : at)
                {
                  const LocalIndex j = at.at({where.first, 48 - where.second});
                  const auto       u = [&](const LocalIndex node, const int d) {
                    return dynamics.displacement.local_element(2 * node + d);
                  };
                  largest = std::max(largest, std::abs(u(i, 1)));
                  difference =
                    std::max({difference, std::abs(u(i, 0) - u(j, 0)), std::abs(u(i, 1) + u(j, 1))});
                }
              ASSERT_LE(difference, 1e-9 * largest) << model << n;
            }
          dynamics.advance();
        }
      // A tip in either half: the farthest node with much damage.
      double     tip[2] = {0, 0};
      const auto damage = moving.bonds->damage();
      for (LocalIndex i = 0; i < position.size(); ++i)
        if (damage[i] > 0.3)
          tip[position[i][1] > 12.] = std::max(tip[position[i][1] > 12.], position[i][0]);
      EXPECT_GT(tip[0], 33.) << model;
      EXPECT_LE(std::abs(tip[0] - tip[1]), 1.) << model;
    }
}

/// A bar whose left end moves in steps a fourth of those of its right one vibrates as one with the shortest
/// steps does, to second order, and keeps energy and momentum as well.
TEST(ExplicitDynamics, SubStepsConserve)
{
  const auto                mesh = test::make_box<2>({48, 4}, {6., 0.5}, 0.1);
  std::vector<unsigned int> levels;
  MovingBody                moving(*mesh, "extended ordinary", {}, 3.01);
  for (const dealii::Point<2> &x : moving.body.nodes.position)
    levels.push_back(x[0] < 1.5 ? 0 : x[0] < 3. ? 1 : 2);
  const auto steps =
    std::make_shared<const LocalSteps>(*moving.body.families, moving.bonds->bond_list(), levels, 3);
  ASSERT_LT(steps->share_of_cell_steps(), 0.7);
  constexpr double end = 8.;
  const auto       run = [&](const unsigned int n_steps, const bool is_local, double &drift) {
    auto dynamics = moving.dynamics(end / n_steps);
    if (is_local)
      dynamics.take_sub_steps(steps);
    for (LocalIndex i = 0; i < moving.body.nodes.size(); ++i)
      dynamics.velocity.local_element(2 * i) = 1e-4 * std::cos(2. * moving.body.nodes.position[i][0]);
    double momentum = 0;
    for (unsigned int n = 0; n <= n_steps; ++n)
      {
        dynamics.evaluate(moving.no_load);
        const EnergyBudget energy = dynamics.energy();
        if (n == 0)
          momentum = dynamics.momentum()[0];
        drift = std::max(drift, std::abs(energy.imbalance()) / energy.external);
        if (n == n_steps)
          break;
        dynamics.advance();
      }
    EXPECT_NEAR(dynamics.momentum()[0], momentum, 1e-17);
    return dynamics.displacement;
  };
  double            drift = 0;
  const NodalVector exact = run(3200, false, drift);
  double            error[2];
  for (unsigned int k = 0; k < 2; ++k)
    {
      drift                  = 0;
      NodalVector difference = run(200 << k, true, drift);
      EXPECT_LE(drift, 1e-7);
      difference -= exact;
      error[k] = difference.l2_norm() / exact.l2_norm();
    }
  EXPECT_LE(error[0], 0.02);
  EXPECT_LE(error[1], 0.3 * error[0]);
}
