// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/bulk_strength.h>

#include "weighed_family.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace perideal;
using perideal::test::WeighedFamily;

namespace
{
  constexpr double strength_strain = 1e-4;

  BondFailing failing(const Softening &softening, const double energy)
  {
    BondFailing how;
    how.law    = SofteningLaw(softening);
    how.energy = energy;
    how.first  = strength_strain;
    return how;
  }

  /// The energy with which bonds of one stretch for all break at a multiple of the strain of the strength.
  template <int dim>
  double energy_for(Separation<dim>                           &separation,
                    const std::vector<dealii::Tensor<1, dim>> &normals,
                    const double                               ratio)
  {
    const auto squares = separation.calibrate({}, normals, 0, separation.of_continuum());
    return std::pow(ratio * strength_strain, 2) / squares.front();
  }

  /// With the first stretch that is found a family bears the strength; it is the smaller the slower bonds
  /// soften.
  template <int dim>
  void expect_strength(const std::string &model,
                       const std::string &form,
                       const double       nu,
                       const Softening   &softening)
  {
    SCOPED_TRACE(model + ' ' + form + ' ' + name_of(softening));
    WeighedFamily<dim>      weighed(model, form, 3.01, nu);
    const auto              normals = directions_of_bonds(weighed.family, dim == 2 ? 24 : 8);
    Separation<dim>         separation(weighed.family, weighed.coefficients, weighed.shape);
    const BulkStrength<dim> strength(weighed.family, weighed.coefficients, weighed.shape, normals, nu);
    double                  before = strength_strain;
    for (const double ratio : {2., 4., 8.})
      {
        BondFailing how     = failing(softening, energy_for(separation, normals, ratio));
        const auto  squares = separation.calibrate(how, normals, 0, separation.of_continuum());
        EXPECT_GT(strength.largest_strain(squares, how), 1.05 * strength_strain);
        how.first = strength.first_stretch(strength_strain, squares, how);
        EXPECT_NEAR(strength.largest_strain(squares, how) / strength_strain, 1., 5e-3);
        EXPECT_LT(how.first, before);
        before = how.first;
      }
  }
} // namespace

TEST(BulkStrength, FamiliesBearTheStrength)
{
  for (const char *softening : {"linear", "bilinear", "exponential"})
    {
      expect_strength<2>("bond based", "", 1. / 3., softening);
      expect_strength<2>("ordinary", "", 0.2, softening);
      expect_strength<2>("extended ordinary", "energy", 0.2, softening);
      expect_strength<3>("extended ordinary", "energy", 0.2, softening);
    }
}

/// Springs whose force stays what it was when they began to soften bear the sum of these forces.
TEST(BulkStrength, OfSpringsThatYieldIsTheSumOfTheirForces)
{
  WeighedFamily<2>  springs("bond based", "", 3.01);
  const double      nu      = 1. / 3.;
  const auto        normals = std::vector<dealii::Tensor<1, 2>>{dealii::Point<2>(1., 0.)};
  const BondFailing how     = failing("linear", 1.);
  // Of an energy without end.
  const std::vector<double> squares(springs.family.size, 1.);
  const auto                stress = [&](const double strain) {
    double result = 0;
    for (LocalIndex j = 0; j < springs.family.size; ++j)
      {
        const double cosine = std::pow(springs.family.bond[0][j], 2) / springs.family.length_square[j];
        result += springs.coefficients.stiffness[j] * std::pow(springs.family.length_square[j], 2) * cosine *
                  std::min(strain * (cosine - nu * (1. - cosine)), 1.);
      }
    return result;
  };
  const double elastic = 10. * stress(0.1);
  double       plastic = 0;
  for (double strain = 1.; strain < 20.; strain += 0.01)
    plastic = std::max(plastic, stress(strain));
  const BulkStrength<2> strength(springs.family, springs.coefficients, springs.shape, normals, nu);
  EXPECT_NEAR(strength.largest_strain(squares, how) / strength_strain, plastic / elastic, 5e-3);
  EXPECT_GT(plastic / elastic, 1.3);
}

TEST(BulkStrength, IsThatOfTheFirstBondWhereBondsBreakAtOnce)
{
  WeighedFamily<2>          springs("bond based", "", 3.01);
  const auto                normals = directions_of_bonds(springs.family, 24);
  const BulkStrength<2>     strength(springs.family, springs.coefficients, springs.shape, normals, 1. / 3.);
  const BondFailing         how = failing("linear", 1.);
  const std::vector<double> squares(springs.family.size, 0.25 * strength_strain * strength_strain);
  EXPECT_EQ(strength.first_stretch(strength_strain, squares, how), strength_strain);
}
