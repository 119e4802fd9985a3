// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/force/relative_damping.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>
#include <functional>

using namespace perideal;

namespace
{
  constexpr double rate = 0.7, density = 3.;

  template <int dim>
  struct DampedBody
  {
    explicit DampedBody(const Mesh<dim> &mesh)
      : body(mesh)
    {
      ModelParameters parameters;
      parameters.model = "bond based";
      parameters.form  = "energy";
      parameters.resolve(dim);
      const auto weights = weigh_bonds<dim>(
        body.families, *create_model<dim>(parameters, 1.), [](const dealii::types::material_id) {
          return ElasticSolid<dim>(ElasticConstants::of_moduli(
            1., 0.6, dim == 3 ? PlaneAssumption::solid : PlaneAssumption::plane_strain));
        });
      bonds   = create_bond_force<dim>(*weights);
      damping = std::make_unique<RelativeDamping<dim>>(
        weights, rate, [](const dealii::types::material_id) { return density; });
      for (NodalVector *vector : {&force, &displacement, &velocity})
        bonds->initialize(*vector);
    }

    using Function = std::function<dealii::Tensor<1, dim>(const dealii::Point<dim> &)>;

    /// Damping forces of a velocity, a function of the present position.
    const NodalVector &force_of(const Function &u, const Function &v)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        {
          const dealii::Point<dim> &x = body.nodes.position[i];
          for (int d = 0; d < dim; ++d)
            {
              displacement.local_element(dim * i + d) = u(x)[d];
              velocity.local_element(dim * i + d)     = v(x + u(x))[d];
            }
        }
      NodalVector elastic(force);
      bonds->compute(elastic, displacement);
      damping->compute(force, velocity, *bonds);
      return force;
    }

    test::Body<dim>                       body;
    std::unique_ptr<BondForce<dim>>       bonds;
    std::unique_ptr<RelativeDamping<dim>> damping;
    NodalVector                           force, displacement, velocity;
  };

  template <int dim>
  dealii::Tensor<1, dim> rough_velocity(const dealii::Point<dim> &x)
  {
    dealii::Tensor<1, dim> result;
    for (int d = 0; d < dim; ++d)
      result[d] = test::scatter(x, 7 * d + 1);
    return result;
  }

  template <int dim>
  void expect_invariants()
  {
    using Vector = dealii::Tensor<1, dim>;
    for (const auto &mesh : test::make_boxes<dim>())
      {
        DampedBody<dim> damped(*mesh);
        const auto      bent = [](const dealii::Point<dim> &x) { return 0.1 * x[0] * Vector(x); };
        damped.force_of(bent, rough_velocity<dim>);
        const double scale = damped.force.linfty_norm();
        ASSERT_GT(scale, 0.);

        // Momentum and angular momentum stay; energy is taken, at most at the largest rate.
        Vector                 sum;
        dealii::Tensor<2, dim> moment;
        double                 power = 0, twice_kinetic = 0;
        for (LocalIndex i = 0; i < damped.body.nodes.size(); ++i)
          {
            Vector f, v;
            for (int d = 0; d < dim; ++d)
              {
                f[d] = damped.force.local_element(dim * i + d);
                v[d] = damped.velocity.local_element(dim * i + d);
              }
            const Vector y = damped.body.nodes.position[i] + bent(damped.body.nodes.position[i]);
            sum += f;
            moment += outer_product(y, f) - outer_product(f, y);
            power += f * v;
            twice_kinetic += density * damped.body.nodes.volume[i] * v.norm_square();
          }
        const MPI_Comm all = MPI_COMM_WORLD;
        EXPECT_LE(dealii::Utilities::MPI::sum(sum, all).norm(), 1e-12 * scale);
        EXPECT_LE(dealii::Utilities::MPI::sum(moment, all).norm(), 1e-12 * scale);
        power         = dealii::Utilities::MPI::sum(power, all);
        twice_kinetic = dealii::Utilities::MPI::sum(twice_kinetic, all);
        EXPECT_LT(power, -0.5 * rate * twice_kinetic); // motion without pattern: about -rate
        EXPECT_GE(power, -damped.damping->largest_rate() * twice_kinetic);
        EXPECT_GT(damped.damping->largest_rate(), 1.9 * rate);
        EXPECT_LT(damped.damping->largest_rate(), 2.2 * dim * rate);

        // Rigid motions, rotations too, of the bent body.
        const auto rigid = [](const dealii::Point<dim> &y) {
          Vector v;
          v[0] = 1. - 2. * y[1];
          v[1] = 3. + 2. * y[0];
          return v;
        };
        EXPECT_LE(damped.force_of(bent, rigid).linfty_norm(), 1e-13 * scale);

        // Lost bonds damp nothing: halves that are cut apart slide freely.
        damped.bonds->cut([](const dealii::Point<dim> &a, const dealii::Point<dim> &b) {
          return (a[0] < 0.45) != (b[0] < 0.45);
        });
        const auto none  = [](const dealii::Point<dim> &) { return Vector(); };
        const auto slide = [](const dealii::Point<dim> &y) {
          Vector v;
          v[0] = y[0] < 0.45 ? -1. : 0.;
          v[1] = y[0] < 0.45 ? 0. : 1.;
          return v;
        };
        EXPECT_LE(damped.force_of(none, slide).linfty_norm(), 1e-13 * scale);
      }
  }
} // namespace

TEST(RelativeDamping, TakesEnergyAndLeavesRigidMotion)
{
  expect_invariants<2>();
  expect_invariants<3>();
}

/// One mode of frequency omega and rate gamma at the limit: roots on the unit circle, and beyond it outside.
TEST(RelativeDamping, LowersTheStableTimeStep)
{
  const double undamped = 0.4, omega = 2 / undamped;
  EXPECT_EQ(damped_time_step(undamped, 0.), undamped);
  for (const double gamma : {0.1, 3., 100.})
    for (const double factor : {0.99, 1.01})
      {
        const double dt = factor * damped_time_step(undamped, gamma);
        double       u = 1., v = 0.;
        for (unsigned int n = 0; n < 5000; ++n)
          {
            v -= dt * (omega * omega * u + gamma * v);
            u += dt * v;
          }
        if (factor < 1)
          EXPECT_LT(std::abs(u), 10.) << gamma;
        else
          EXPECT_FALSE(std::abs(u) < 1e3) << gamma; // it may have overflown
      }
}
