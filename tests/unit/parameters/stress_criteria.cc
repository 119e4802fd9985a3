// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/material_parameters.h>
#include <perideal/parameters/stress_criteria.h>

#include <deal.II/base/numbers.h>
#include <deal.II/physics/transformations.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;

namespace
{
  using Stress = dealii::SymmetricTensor<2, 3>;

  // Those of the double-edge-notched specimen (VNOSB table 1).
  const double          f_t = 3e6, f_c = 38.4e6;
  const StressCriterion rankine("maximum tensile stress", f_t, 0.), coulomb("Mohr-Coulomb", f_t, f_c);

  Stress principal(const double s1, const double s2, const double s3)
  {
    Stress result;
    result[0][0] = s1;
    result[1][1] = s2;
    result[2][2] = s3;
    return result;
  }

  /// Turned about an axis oblique to all others.
  Stress turned(const Stress &stress)
  {
    dealii::Tensor<1, 3> axis;
    axis[0] = axis[1] = axis[2] = 1. / std::sqrt(3.);
    using namespace dealii::Physics::Transformations;
    return basis_transformation(stress, Rotations::rotation_matrix_3d(axis, 0.7));
  }
} // namespace

// The principal stresses are the roots of a cubic: digits are lost where two are equal, and eight are left.
constexpr double precision = 1e-8;

TEST(StressCriteria, UniaxialStrengthsAreThose)
{
  for (const bool is_turned : {false, true})
    {
      const Stress pull = principal(f_t, 0., 0.), push = principal(0., 0., -f_c);
      EXPECT_NEAR(rankine.utilisation(is_turned ? turned(pull) : pull), 1., precision);
      EXPECT_NEAR(coulomb.utilisation(is_turned ? turned(pull) : pull), 1., precision);
      EXPECT_NEAR(rankine.utilisation(is_turned ? turned(push) : push), 0., f_c / f_t * precision);
      EXPECT_NEAR(coulomb.utilisation(is_turned ? turned(push) : push), 1., f_c / f_t * precision);
    }
}

TEST(StressCriteria, PureShear)
{
  Stress shear;
  shear[0][1] = 1e6;
  EXPECT_NEAR(rankine.utilisation(shear), 1e6 / f_t, precision);
  EXPECT_NEAR(coulomb.utilisation(shear), 1e6 / f_t + 1e6 / f_c, precision);
}

TEST(StressCriteria, TheStressAcrossAPlaneCounts)
{
  // Two pressures in a plane: without stress across it sigma_1 is 0, in plane strain it is a pressure, too.
  EXPECT_NEAR(coulomb.utilisation(principal(-1e6, -2e6, 0.)), 2e6 / f_c, precision);
  EXPECT_NEAR(coulomb.utilisation(principal(-1e6, -2e6, -0.6e6)), 2e6 / f_c - 0.6e6 / f_t, precision);
  EXPECT_NEAR(rankine.utilisation(principal(-1e6, -2e6, 2e6)), 2e6 / f_t, precision);
}

TEST(StressCriteria, MohrCoulombIsTheLineOfItsCohesionAndAngle)
{
  const double c = std::sqrt(f_t * f_c) / 2, sine = (f_c - f_t) / (f_c + f_t);
  const double cosine = std::sqrt(1 - sine * sine);
  // On the line tau = c cos(phi) - (s1 + s3)/2 sin(phi), tension positive, at any mean stress.
  for (const double mean : {-50e6, -5e6, 0., 1e6})
    {
      const double tau = c * cosine - mean * sine;
      ASSERT_GT(tau, 0.);
      EXPECT_NEAR(coulomb.utilisation(principal(mean + tau, mean, mean - tau)),
                  1.,
                  (std::abs(mean) + tau) / f_t * precision);
    }
  // With the sign as printed in VNOSB (18) the line is that of a material f_c strong in a pull.
  const double as_printed = c * cosine + f_t / 2 * sine;
  EXPECT_LT(f_t / 2, 0.6 * as_printed) << "a pull of f_t would not break it";
  EXPECT_NEAR(f_c / 2, c * cosine + f_c / 2 * sine, 1e-6 * f_c) << "a pull of f_c would";
}

TEST(StressCriteria, DruckerPragerIsAConeThroughBothStrengths)
{
  const StressCriterion cone("Drucker-Prager", f_t, f_c), mises("Drucker-Prager", f_t, f_t);
  for (const auto &stress : {principal(f_t, 0., 0.), principal(0., 0., -f_c)})
    {
      EXPECT_NEAR(cone.utilisation(stress), 1., 1e-14);
      EXPECT_NEAR(cone.utilisation(turned(stress)), 1., 1e-12);
    }
  // Pure shear fails at k, an expansion on all sides at k/(3 a), a pressure never.
  const double k = 2. * f_c * f_t / (std::sqrt(3.) * (f_c + f_t));
  const double a = (f_c - f_t) / (std::sqrt(3.) * (f_c + f_t)), tip = k / (3. * a);
  Stress       shear;
  shear[0][1] = k;
  EXPECT_NEAR(cone.utilisation(shear), 1., 1e-14);
  EXPECT_NEAR(cone.utilisation(principal(tip, tip, tip)), 1., 1e-14);
  EXPECT_LT(cone.utilisation(principal(-f_c, -f_c, -f_c)), 0.);
  // Between the principal stresses it is a circle: any order of them, and between them, on one mean stress.
  const double mean = -0.4 * f_c, radius = std::sqrt(2.) * (k - 3. * a * mean);
  for (const double angle : {0., 0.3, 1., 2., 4.})
    {
      const double third = 2. * dealii::numbers::PI / 3., s = std::sqrt(2. / 3.) * radius;
      EXPECT_NEAR(cone.utilisation(principal(mean + s * std::cos(angle),
                                             mean + s * std::cos(angle - third),
                                             mean + s * std::cos(angle + third))),
                  1.,
                  1e-12);
    }
  // Of equal strengths, that of von Mises: pressure does not count.
  EXPECT_NEAR(mises.utilisation(principal(f_t - 9e6, -9e6, -9e6)), 1., 1e-14);
}

TEST(StressCriteria, OfAMaterialOfAScene)
{
  MaterialParameters parameters;
  const Stress       pull = principal(f_t, 0., 0.);
  EXPECT_FALSE(stress_criterion(parameters, parameters.body).can_fail());
  parameters.failure_criterion = "maximum tensile stress";
  EXPECT_FALSE(stress_criterion(parameters, parameters.body).can_fail()) << "no strength: unbreakable";
  EXPECT_EQ(stress_criterion(parameters, parameters.body).utilisation(pull), 0.);
  parameters.body.tensile_strength = 2 * f_t;
  EXPECT_TRUE(stress_criterion(parameters, parameters.body).can_fail());
  EXPECT_NEAR(stress_criterion(parameters, parameters.body).utilisation(pull), 0.5, precision);
  parameters.failure_criterion         = "Mohr-Coulomb";
  parameters.body.compressive_strength = f_c;
  EXPECT_NEAR(
    stress_criterion(parameters, parameters.body).utilisation(principal(0., 0., -f_c)), 1., precision);
}
