// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/elastic_state.h>

#include "solids.h"

#include <gtest/gtest.h>

using namespace perideal;

namespace
{
  constexpr double young = 70e9, nu = 0.3;

  /// The strain that Hooke's law in space gives to a stress.
  dealii::SymmetricTensor<2, 3> strain_of(const dealii::SymmetricTensor<2, 3> &stress)
  {
    auto result = (1. + nu) / young * stress;
    for (int d = 0; d < 3; ++d)
      result[d][d] -= nu / young * trace(stress);
    return result;
  }

  dealii::SymmetricTensor<2, 2> in_plane(const dealii::SymmetricTensor<2, 3> &tensor)
  {
    dealii::SymmetricTensor<2, 2> result;
    for (int a = 0; a < 2; ++a)
      for (int b = a; b < 2; ++b)
        result[a][b] = tensor[a][b];
    return result;
  }

  dealii::SymmetricTensor<2, 3> plane_stress_of(const double xx, const double yy, const double xy)
  {
    dealii::SymmetricTensor<2, 3> stress;
    stress[0][0] = xx;
    stress[1][1] = yy;
    stress[0][1] = xy;
    return stress;
  }

  void expect_state(const ElasticState                  &state,
                    const dealii::SymmetricTensor<2, 3> &stress,
                    const dealii::SymmetricTensor<2, 3> &strain)
  {
    EXPECT_LE((state.stress - stress).norm(), 1e-13 * stress.norm());
    EXPECT_LE((state.strain - strain).norm(), 1e-13 * strain.norm());
    EXPECT_NEAR(state.energy_density, 0.5 * (stress * strain), 1e-13 * (stress * strain));
  }
} // namespace

TEST(ElasticState, InSpace)
{
  auto stress  = plane_stress_of(3e6, -1e6, 2e6);
  stress[2][2] = 5e6;
  stress[1][2] = -4e6;
  stress[0][2] = 1e6;
  expect_state(elastic_state<3>(strain_of(stress), ElasticConstants{young, nu, PlaneAssumption::solid}),
               stress,
               strain_of(stress));
}

TEST(ElasticState, PlaneStressStretchesAcross)
{
  const auto stress = plane_stress_of(3e6, -1e6, 2e6);
  const auto strain = strain_of(stress);
  expect_state(elastic_state<2>(in_plane(strain), ElasticConstants{young, nu, PlaneAssumption::plane_stress}),
               stress,
               strain);
}

TEST(ElasticState, PlaneStrainPullsAcross)
{
  auto stress       = plane_stress_of(3e6, -1e6, 2e6);
  stress[2][2]      = nu * 2e6;
  const auto strain = strain_of(stress);
  EXPECT_NEAR(strain[2][2], 0., 1e-20);
  expect_state(elastic_state<2>(in_plane(strain), ElasticConstants{young, nu, PlaneAssumption::plane_strain}),
               stress,
               strain);
}

TEST(ElasticState, OfAnySolid)
{
  const auto c = test::stiffness_without_symmetry();
  // Plane stress: of all states in space the one without stress across the plane.
  const auto stress = plane_stress_of(3e6, -1e6, 2e6);
  const auto strain = dealii::invert(c) * stress;
  EXPECT_GT(std::abs(strain[1][2]), 1e-3 * strain.norm());
  expect_state(
    elastic_state(in_plane(strain), ElasticSolid<2>(c, PlaneAssumption::plane_stress)), stress, strain);
  // Plane strain: the one without strain across it.
  const auto flat = plane_stress_of(1e-3, -2e-3, 5e-4);
  EXPECT_GT(std::abs((c * flat)[1][2]), 1e-3 * (c * flat).norm());
  expect_state(
    elastic_state(in_plane(flat), ElasticSolid<2>(c, PlaneAssumption::plane_strain)), c * flat, flat);
  expect_state(elastic_state(strain, ElasticSolid<3>(c, PlaneAssumption::solid)), stress, strain);
}

TEST(ElasticState, EquivalentAndPrincipalStresses)
{
  ElasticState state;
  state.stress = plane_stress_of(2e6, 0., 0.);
  EXPECT_NEAR(state.von_mises(), 2e6, 1e-7);
  EXPECT_NEAR(state.largest_principal(), 2e6, 1e-7);
  EXPECT_NEAR(state.smallest_principal(), 0., 1e-7);
  state.stress = plane_stress_of(0., 0., 3e6);
  EXPECT_NEAR(state.von_mises(), 3e6 * std::sqrt(3.), 1e-7);
  EXPECT_NEAR(state.largest_principal(), 3e6, 1e-7);
  EXPECT_NEAR(state.smallest_principal(), -3e6, 1e-7);
  state.stress = plane_stress_of(7e6, 1e6, 4e6);
  EXPECT_NEAR(state.largest_principal(), 9e6, 1e-7);
  EXPECT_NEAR(state.smallest_principal(), -1e6, 1e-7);
}

TEST(ElasticState, TriaxialityOfKnownStates)
{
  ElasticState state;
  EXPECT_EQ(state.triaxiality(), 0.);
  state.stress = plane_stress_of(2e6, 0, 0);
  EXPECT_NEAR(state.triaxiality(), 1. / 3., 1e-15);
  state.stress = plane_stress_of(-2e6, -2e6, 0);
  EXPECT_NEAR(state.triaxiality(), -2. / 3., 1e-15);
  state.stress = plane_stress_of(0, 0, 3e6);
  EXPECT_NEAR(state.triaxiality(), 0., 1e-15);
  // Nothing is sheared: no quotient of rounding errors.
  state.stress = 5e6 * dealii::unit_symmetric_tensor<3>();
  EXPECT_EQ(state.triaxiality(), 0.);
}
