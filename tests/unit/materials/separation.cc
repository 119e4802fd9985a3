// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/ordinary.h>
#include <perideal/materials/separation.h>

#include "weighed_family.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace perideal;
using perideal::test::WeighedFamily;

namespace
{
  /// Twice the energy of a whole family of springs, a plane of this normal being opened by one, over its
  /// volume.
  template <int dim>
  double work_of_springs(const WeighedFamily<dim>     &weighed,
                         const dealii::Tensor<1, dim> &normal,
                         const double                  square)
  {
    double result = 0;
    for (LocalIndex j = 0; j < weighed.family.size; ++j)
      {
        double reach = 0;
        for (int d = 0; d < dim; ++d)
          reach += normal[d] * weighed.family.bond[d][j];
        // k |xi|^4 s^2/2 of each bond, as often as it crosses: both halves of it, over |xi.n|.
        result += 0.5 * weighed.coefficients.stiffness[j] * std::pow(weighed.family.length_square[j], 2) *
                  square * std::abs(reach) / weighed.family.node_volume;
      }
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim> direction(const double x, const double y, const double z)
  {
    dealii::Tensor<1, dim> result;
    const double           components[] = {x, y, z};
    for (int d = 0; d < dim; ++d)
      result[d] = components[d];
    return result / result.norm();
  }

  /// Springs: each bond takes its own energy, whenever it breaks.
  template <int dim>
  void expect_energy_of_springs()
  {
    WeighedFamily<dim>  springs("bond based", "", 3.01);
    Separation<dim>     separation(springs.family, springs.coefficients, springs.shape);
    std::vector<double> squares(springs.family.size, 1e-4), by_member;
    for (const auto &normal :
         {direction<dim>(0, 1, 0), direction<dim>(1, 2, 3), direction<dim>(-1, 0.3, 0.2)})
      EXPECT_NEAR(
        separation.energy(normal, squares, by_member) / work_of_springs(springs, normal, 1e-4), 1., 1e-12);
  }

  /// Calibrated, planes normal to bonds take the energy, and all others nearly.
  template <int dim>
  void expect_calibrated(const std::string &model,
                         const std::string &form,
                         const double       horizon_factor,
                         const double       poisson_ratio,
                         const std::string &influence,
                         const Softening   &softening)
  {
    SCOPED_TRACE(model + ' ' + form + ' ' + std::to_string(horizon_factor) + ' ' +
                 std::to_string(poisson_ratio) + ' ' + influence + ' ' + name_of(softening));
    WeighedFamily<dim> weighed(model, form, horizon_factor, poisson_ratio, influence);
    Separation<dim>    separation(weighed.family, weighed.coefficients, weighed.shape);
    const auto         normals = directions_of_bonds(weighed.family, 24);
    BondFailing        how;
    how.law                     = SofteningLaw(softening);
    how.first_share             = std::sqrt(1. / 3.);
    const auto          squares = separation.calibrate(how, normals, 5, separation.of_continuum());
    std::vector<double> by_member;
    if (!how.law.softens())
      {
        EXPECT_NEAR(separation.energy(direction<dim>(0, 1, 0), squares, by_member), 1., 0.01);
        // Bonds with tensors store what goes across them, too: between bonds planes take up to a quarter
        // less.
        const auto shares = separation.by_direction(squares, how);
        if (weighed.shape.bond_tensors)
          return;
        EXPECT_NEAR(shares.mean, 1., horizon_factor < 3 ? 0.08 : 0.02);
        EXPECT_GT(shares.smallest, 0.97);
        EXPECT_LT(shares.largest, horizon_factor < 3 ? 1.12 : 1.05);
      }
    for (const double square : squares)
      EXPECT_GT(square, 0.);
    // What bonds take grows with the energy wanted, as long as no strength is given.
    how.energy            = 100.;
    const auto for_energy = separation.calibrate(how, normals, 5, separation.of_continuum());
    for (LocalIndex j = 0; j < weighed.family.size; ++j)
      EXPECT_NEAR(for_energy[j] / squares[j], 1., 1e-9);
  }
} // namespace

TEST(Separation, SpringsTakeTheirOwnEnergy)
{
  expect_energy_of_springs<2>();
  expect_energy_of_springs<3>();
}

TEST(Separation, CalibratedBondsTakeTheFractureEnergy)
{
  for (const char *softening : {"none", "linear"})
    for (const double nu : {0.1, 0.3, 0.45})
      for (const char *influence : {"constant", "inverse", "gaussian", "cubic spline"})
        {
          expect_calibrated<2>("ordinary", "", 3.01, nu, influence, softening);
          expect_calibrated<2>("extended ordinary", "energy", 3.01, nu, influence, softening);
        }
  for (const double factor : {2.01, 4.01, 5.01})
    expect_calibrated<2>("ordinary", "", factor, 0.25, "constant", "none");
  expect_calibrated<2>("extended ordinary", "paper", 3.01, 0.3, "constant", "none");
  expect_calibrated<2>("tensor involved", "moment corrected", 3.01, 0.3, "constant", "none");
  expect_calibrated<3>("bond based", "", 3.01, 0.25, "constant", "none");
  expect_calibrated<3>("extended ordinary", "energy", 3.01, 0.3, "constant", "none");
}

/// Planes normal to the axes take 0.4 and 1.6 of the mean; those between the root of the sum of squares; near
/// the weak axis, where no bond is, a sixth more.
TEST(Separation, TakesTheEnergyOfTheDirection)
{
  dealii::SymmetricTensor<2, 2> by_normal;
  by_normal[0][0] = 0.4;
  by_normal[1][1] = 1.6;
  for (const auto &model : {std::make_pair("ordinary", ""), std::make_pair("extended ordinary", "energy")})
    for (const char *softening : {"none", "linear"})
      {
        SCOPED_TRACE(std::string(model.first) + ' ' + softening);
        WeighedFamily<2> weighed(model.first, model.second, 3.01);
        Separation<2>    separation(weighed.family, weighed.coefficients, weighed.shape, by_normal);
        Separation<2>    plain(weighed.family, weighed.coefficients, weighed.shape);
        BondFailing      how;
        how.law         = SofteningLaw(softening);
        how.first_share = std::sqrt(0.5);
        const auto squares =
          separation.calibrate(how, directions_of_bonds(weighed.family, 24), 5, separation.of_continuum());
        const auto shares = separation.by_direction(squares, how);
        EXPECT_NEAR(shares.mean, 1., 0.05);
        EXPECT_GT(shares.smallest, 0.95);
        EXPECT_LT(shares.largest, 1.2);
        if (how.law.softens())
          continue;
        std::vector<double> by_member;
        EXPECT_NEAR(plain.energy(direction<2>(1, 0, 0), squares, by_member), 0.4, 0.02);
        EXPECT_NEAR(plain.energy(direction<2>(0, 1, 0), squares, by_member), 1.6, 0.04);
        EXPECT_NEAR(
          plain.energy(direction<2>(1, 1, 0), squares, by_member), std::sqrt(0.5 * (0.16 + 2.56)), 0.03);
      }
}

TEST(Separation, PublishedStretchesDoNotTakeIt)
{
  // A constant influence function takes a tenth more, by the weights of round families also.
  WeighedFamily<2> weighed("ordinary", "", 3.01);
  Separation<2>    separation(weighed.family, weighed.coefficients, weighed.shape);
  const double     published = ordinary_critical_stretch({1., 0.3, PlaneAssumption::plane_strain}, 1., 3.01);
  std::vector<double> by_member;
  EXPECT_GT(separation.by_direction(std::vector<double>(weighed.family.size, published * published), {}).mean,
            1.08);
}
