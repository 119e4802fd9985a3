// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/consistent.h>

#include "solids.h"

#include <gtest/gtest.h>

using namespace perideal;

TEST(Consistent, StabilisesWithTheShearModulusOfIsotropicSolids)
{
  for (const double nu : {-0.5, 0.3})
    {
      const ElasticConstants constants{70e9, nu, PlaneAssumption::plane_stress};
      EXPECT_EQ(Consistent<2>::stabilising_modulus(constants), constants.shear_modulus());
    }
}

TEST(Consistent, StabilisesOthersWithTheStrainTheyResistLeast)
{
  // Nearly isotropic, nearly the same.
  const ElasticConstants              constants{1., 0.3, PlaneAssumption::solid};
  const dealii::SymmetricTensor<4, 3> c    = ElasticSolid<3>(constants).stiffness();
  dealii::SymmetricTensor<4, 3>       soft = c;
  soft[0][1][0][1] *= 1. - 1e-6;
  const ElasticSolid<3> near(soft, PlaneAssumption::solid);
  ASSERT_FALSE(near.is_isotropic());
  EXPECT_NEAR(Consistent<3>::stabilising_modulus(near), (1. - 1e-6) * constants.shear_modulus(), 1e-12);

  // One soft shear is what counts.
  soft[0][1][0][1] = 0.1 * constants.shear_modulus();
  EXPECT_NEAR(Consistent<3>::stabilising_modulus(ElasticSolid<3>(soft, PlaneAssumption::solid)),
              0.1 * constants.shear_modulus(),
              1e-12);
}
