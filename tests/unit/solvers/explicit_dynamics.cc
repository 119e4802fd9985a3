// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/solvers/explicit_dynamics.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>

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
      , loads(text)
      , held(find_boundary_faces(mesh, body.nodes), loads, resolve_boundaries(mesh, loads), body.nodes.size())
      , mass(body.nodes.volume)
    {
      ModelParameters parameters;
      parameters.model = model;
      parameters.form  = "energy";
      parameters.resolve(2);
      const ElasticConstants constants =
        parameters.constants_of_model({1., 0.3, PlaneAssumption::plane_stress});
      const auto moduli = [&](const dealii::types::material_id) {
        return Moduli{constants.bulk_modulus(), constants.shear_modulus()};
      };
      bonds = create_bond_force<2>(*weigh_bonds<2>(body.families, *create_model<2>(parameters, 1.), moduli));
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
    HeldNodes<2>                  held;
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
