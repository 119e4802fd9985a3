// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/ordinary.h>
#include <perideal/materials/tensor_involved.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace perideal;

TEST(CriticalStretch, AgreesWithTheFormulasInEAndNu)
{
  // The second forms of TIPD eqs. (43), with the printed G read as G0, and (56).
  const double E = 72e9, nu = 0.22, G0 = 135., d = 3e-3, pi = std::acos(-1.);
  EXPECT_NEAR(
    ordinary_critical_stretch({E, nu, PlaneAssumption::plane_stress}, G0, d),
    std::sqrt(9 * pi * pi * (1 + nu) * (1 - nu) * G0 / ((8 * (3 * nu - 1) + 27 * pi * (1 - nu)) * E * d)),
    1e-15);
  EXPECT_NEAR(ordinary_critical_stretch({E, nu, PlaneAssumption::solid}, G0, d),
              std::sqrt(1536 * (1 + nu) * (1 - 2 * nu) * G0 / ((2061 - 3636 * nu) * E * d)),
              1e-15);
}

TEST(CriticalStretch, OfTensorInvolvedBondsIsThePublishedOne)
{
  // TIPD eqs. (41), (54).
  const double E = 72e9, nu = 0.22, G0 = 135., d = 3e-3, pi = std::acos(-1.);
  EXPECT_NEAR(tensor_critical_stretch({E, nu, PlaneAssumption::plane_stress}, G0, d),
              std::sqrt(8 * pi * G0 * (1 - nu * nu) / (3 * E * d * (5 + nu))),
              1e-15);
  EXPECT_NEAR(tensor_critical_stretch({E, nu, PlaneAssumption::solid}, G0, d),
              std::sqrt(10 * G0 * (1 - 2 * nu) * (1 + nu) / (3 * E * d * (3 - 2 * nu))),
              1e-15);
}

TEST(CriticalStretch, IsTheBondBasedOneWhereTheModelsAgree)
{
  // nu = 1/3 in plane stress, 1/4 in 3-D: TIPD eqs. (42), (55).
  const double E = 1., G0 = 1., d = 1., pi = std::acos(-1.);
  for (const auto &stretch : {ordinary_critical_stretch, tensor_critical_stretch})
    {
      EXPECT_NEAR(stretch({E, 1. / 3, PlaneAssumption::plane_stress}, G0, d),
                  std::sqrt(4 * pi * G0 / (9 * E * d)),
                  1e-14);
      EXPECT_NEAR(stretch({E, 0.25, PlaneAssumption::solid}, G0, d), std::sqrt(5 * G0 / (6 * E * d)), 1e-14);
    }
}
