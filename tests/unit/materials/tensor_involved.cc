// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/bond_based.h>
#include <perideal/materials/lattice.h>
#include <perideal/materials/tensor_involved.h>

#include "testing.h"

#include <cmath>
#include <random>

using namespace perideal;
using dealii::SymmetricTensor;

namespace
{
  /// Axes of a Voigt index; 3-D in the order of the paper's appendix, 4 = 12, 5 = 13, 6 = 23.
  template <int dim>
  dealii::TableIndices<2> axes(const unsigned int voigt)
  {
    return SymmetricTensor<2, dim>::unrolled_to_component_indices(voigt - 1);
  }

  /// A random positive definite stiffness, with its Voigt matrix Q[a][b], a and b from 1 on.
  template <int dim>
  struct RandomSolid
  {
    static constexpr unsigned int n = SymmetricTensor<2, dim>::n_independent_components;

    explicit RandomSolid(const unsigned int seed)
    {
      std::mt19937                           engine(seed);
      std::uniform_real_distribution<double> entry(-1., 1.);
      double                                 factor[n][n];
      for (auto &row : factor)
        for (double &value : row)
          value = entry(engine);
      for (unsigned int a = 1; a <= n; ++a)
        for (unsigned int b = 1; b <= n; ++b)
          {
            q[a][b] = a == b ? 0.5 : 0.;
            for (unsigned int k = 0; k < n; ++k)
              q[a][b] += factor[a - 1][k] * factor[b - 1][k];
            stiffness[axes<dim>(a)[0]][axes<dim>(a)[1]][axes<dim>(b)[0]][axes<dim>(b)[1]] = q[a][b];
          }
    }

    double                  q[n + 1][n + 1];
    SymmetricTensor<4, dim> stiffness;
  };

  /// Moments of a full sphere bring D back to the stiffness of waves.
  template <int dim>
  void expect_tensor_identity()
  {
    const auto delta = [](const int a, const int b) { return a == b ? 1. : 0.; };
    for (unsigned int seed = 1; seed <= 20; ++seed)
      {
        const RandomSolid<dim> solid(seed);
        const auto             d    = TensorInvolved<dim>::micromodulus(solid.stiffness);
        const auto            &c    = solid.stiffness;
        const double           size = solid.stiffness.norm();
        for (int i = 0; i < dim; ++i)
          for (int k = 0; k < dim; ++k)
            for (int p = 0; p < dim; ++p)
              for (int q = 0; q < dim; ++q)
                {
                  double found = 0;
                  for (int a = 0; a < dim; ++a)
                    for (int b = 0; b < dim; ++b)
                      found +=
                        0.5 * d[i][k][a][b] *
                        (delta(a, b) * delta(p, q) + delta(a, p) * delta(b, q) + delta(a, q) * delta(b, p));
                  EXPECT_NEAR(found, 0.5 * (c[i][p][k][q] + c[i][q][k][p]), 1e-13 * size);
                }
      }
  }

  template <int dim>
  FamilyCoefficients compute(const typename TensorInvolved<dim>::Moments moments,
                             const FamilyView<dim>                      &family)
  {
    TensorInvolved<dim> model(moments, 1.);
    FamilyCoefficients  result;
    result.resize(family.size, model.shape());
    model.compute(family, result);
    return result;
  }

  /// The bonds of the model for a solid with the ratio that bonds alone have.
  template <int dim>
  void expect_bond_based(const PlaneAssumption assumption)
  {
    const ElasticSolid<dim> solid(
      ElasticConstants{70e9, BondBased<dim>::poisson_ratio(assumption), assumption});
    FamilyView<dim> family = lattice_family<dim>(3.01);
    family.set_solid(solid);
    BondBased<dim>     springs(1.);
    FamilyCoefficients expected;
    expected.resize(family.size, springs.shape());
    springs.compute(family, expected);
    const auto found = compute<dim>(TensorInvolved<dim>::Moments::sphere, family);
    for (LocalIndex j = 0; j < family.size; ++j)
      for (unsigned int p = 0; p < SymmetricTensor<2, dim>::n_independent_components; ++p)
        {
          const auto a = SymmetricTensor<2, dim>::unrolled_to_component_indices(p);
          EXPECT_NEAR(found.tensor[p][j],
                      expected.stiffness[j] * family.bond[a[0]][j] * family.bond[a[1]][j],
                      1e-13 * expected.stiffness[j] * family.length_square[j]);
        }
  }

  /// sum_j tensor_ik xi_p xi_q = V S_ikpq: what the family makes of uniform second gradients, both halves of
  /// its bonds taken together, is exact; returns the largest error relative to S.
  template <int dim>
  double error_of_second_gradients(const FamilyView<dim> &family, const FamilyCoefficients &coefficients)
  {
    const auto s     = TensorInvolved<dim>::symmetrised(family.stiffness);
    double     error = 0;
    for (unsigned int n = 0; n < SymmetricTensor<2, dim>::n_independent_components; ++n)
      for (int p = 0; p < dim; ++p)
        for (int q = 0; q < dim; ++q)
          {
            const auto ik  = SymmetricTensor<2, dim>::unrolled_to_component_indices(n);
            double     sum = 0;
            for (LocalIndex j = 0; j < family.size; ++j)
              sum += coefficients.tensor[n][j] * family.bond[p][j] * family.bond[q][j];
            error = std::max(error, std::abs(sum - s[ik[0]][ik[1]][p][q]) / s.norm());
          }
    return error;
  }
} // namespace

TEST(TensorInvolved, SphereMomentsGiveTheStiffnessBack2D)
{
  expect_tensor_identity<2>();
}

TEST(TensorInvolved, SphereMomentsGiveTheStiffnessBack3D)
{
  expect_tensor_identity<3>();
}

TEST(TensorInvolved, EqualsTable32)
{
  const RandomSolid<2> solid(7);
  const auto          &q = solid.q;
  // The paper's tensor has the kernel 1/(pi d^3 h); its index 6 is our third.
  const auto   d          = 12. * TensorInvolved<2>::micromodulus(solid.stiffness);
  const double table[][5] = {
    {1, 1, 9 * q[1][1] - 3 * q[3][3], 12 * q[1][3], 9 * q[3][3] - 3 * q[1][1]},
    {1, 2, 9 * q[1][3] - 3 * q[2][3], 6 * (q[1][2] + q[3][3]), 9 * q[2][3] - 3 * q[1][3]},
    {2, 2, 9 * q[3][3] - 3 * q[2][2], 12 * q[2][3], 9 * q[2][2] - 3 * q[3][3]}};
  for (const auto &row : table)
    {
      const int i = row[0] - 1, k = row[1] - 1;
      EXPECT_NEAR(d[i][k][0][0], row[2], 1e-13 * 12 * solid.stiffness.norm());
      EXPECT_NEAR(d[i][k][0][1], row[3], 1e-13 * 12 * solid.stiffness.norm());
      EXPECT_NEAR(d[i][k][1][1], row[4], 1e-13 * 12 * solid.stiffness.norm());
    }
}

TEST(TensorInvolved, EqualsTable34OfIsotropicPlates)
{
  for (const double nu : {0.1, 0.25, 1. / 3.})
    {
      const ElasticSolid<2> solid(ElasticConstants{1., nu, PlaneAssumption::plane_stress});
      const auto            d = 12. * (1. - nu * nu) * TensorInvolved<2>::micromodulus(solid.stiffness());
      EXPECT_NEAR(d[0][0][0][0], 0.5 * (15 + 3 * nu), 1e-13);
      EXPECT_NEAR(d[0][0][1][1], 0.5 * (3 - 9 * nu), 1e-13);
      EXPECT_NEAR(d[0][1][0][1], 3 * (1 + nu), 1e-13);
      EXPECT_NEAR(d[1][1][1][1], 0.5 * (15 + 3 * nu), 1e-13);
      EXPECT_NEAR(d[0][0][0][1], 0., 1e-13);
    }
}

TEST(TensorInvolved, EqualsTable52WithoutItsMisprints)
{
  const RandomSolid<3> solid(11);
  const auto          &q = solid.q;
  const auto           d = 15. * TensorInvolved<3>::micromodulus(solid.stiffness);
  // Rows (i, k), columns (c, d) = 11, 12, 13, 22, 23, 33. Entries corrected: 11,11; 11,13; 21,23; 21,33;
  // 31,11; 31,22; 22,22; 32,12; 33,22; 33,33.
  struct Row
  {
    int    i, k;
    double value[6];
  };
  const Row table[]      = {{1,
                             1,
                             {3 * (4 * q[1][1] - q[4][4] - q[5][5]),
                              15 * q[1][4],
                              15 * q[1][5],
                              3 * (4 * q[4][4] - q[1][1] - q[5][5]),
                              15 * q[4][5],
                              3 * (4 * q[5][5] - q[1][1] - q[4][4])}},
                            {2,
                             1,
                             {3 * (4 * q[1][4] - q[2][4] - q[5][6]),
                              7.5 * (q[1][2] + q[4][4]),
                              7.5 * (q[1][6] + q[4][5]),
                              3 * (4 * q[2][4] - q[1][4] - q[5][6]),
                              7.5 * (q[4][6] + q[2][5]),
                              3 * (4 * q[5][6] - q[2][4] - q[1][4])}},
                            {3,
                             1,
                             {3 * (4 * q[1][5] - q[4][6] - q[3][5]),
                              7.5 * (q[1][6] + q[4][5]),
                              7.5 * (q[1][3] + q[5][5]),
                              3 * (4 * q[4][6] - q[1][5] - q[3][5]),
                              7.5 * (q[3][4] + q[5][6]),
                              3 * (4 * q[3][5] - q[1][5] - q[4][6])}},
                            {2,
                             2,
                             {3 * (4 * q[4][4] - q[2][2] - q[6][6]),
                              15 * q[2][4],
                              15 * q[4][6],
                              3 * (4 * q[2][2] - q[4][4] - q[6][6]),
                              15 * q[2][6],
                              3 * (4 * q[6][6] - q[2][2] - q[4][4])}},
                            {3,
                             2,
                             {3 * (4 * q[4][5] - q[2][6] - q[3][6]),
                              7.5 * (q[4][6] + q[2][5]),
                              7.5 * (q[3][4] + q[5][6]),
                              3 * (4 * q[2][6] - q[4][5] - q[3][6]),
                              7.5 * (q[2][3] + q[6][6]),
                              3 * (4 * q[3][6] - q[4][5] - q[2][6])}},
                            {3,
                             3,
                             {3 * (4 * q[5][5] - q[6][6] - q[3][3]),
                              15 * q[5][6],
                              15 * q[3][5],
                              3 * (4 * q[6][6] - q[5][5] - q[3][3]),
                              15 * q[3][6],
                              3 * (4 * q[3][3] - q[5][5] - q[6][6])}}};
  const int column[6][2] = {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}};
  for (const Row &row : table)
    for (unsigned int n = 0; n < 6; ++n)
      EXPECT_NEAR(d[row.i - 1][row.k - 1][column[n][0]][column[n][1]],
                  row.value[n],
                  1e-13 * 15 * solid.stiffness.norm())
        << row.i << row.k << ", column " << n;
}

TEST(TensorInvolved, IsBondBasedAtItsPoissonRatio)
{
  expect_bond_based<2>(PlaneAssumption::plane_stress);
  expect_bond_based<2>(PlaneAssumption::plane_strain);
  expect_bond_based<3>(PlaneAssumption::solid);
}

TEST(TensorInvolved, MomentsOfTheFamilyAreExactForSecondGradients)
{
  FamilyView<2> flat = lattice_family<2>(3.01);
  flat.stiffness     = RandomSolid<2>(3).stiffness;
  EXPECT_LE(error_of_second_gradients(flat, compute<2>(TensorInvolved<2>::Moments::family, flat)), 1e-13);
  EXPECT_GE(error_of_second_gradients(flat, compute<2>(TensorInvolved<2>::Moments::sphere, flat)), 1e-3);
  FamilyView<3> solid = lattice_family<3>(3.01);
  solid.stiffness     = RandomSolid<3>(3).stiffness;
  EXPECT_LE(error_of_second_gradients(solid, compute<3>(TensorInvolved<3>::Moments::family, solid)), 1e-13);
}

TEST(TensorInvolved, FlatFamiliesAreReported)
{
  // The horizon reaches the nearest cells only: nothing is known of shear.
  FamilyView<2> family = lattice_family<2>(1.01);
  family.stiffness     = RandomSolid<2>(3).stiffness;
  EXPECT_TRUE(compute<2>(TensorInvolved<2>::Moments::family, family).report.singular);
  EXPECT_FALSE(compute<2>(TensorInvolved<2>::Moments::sphere, family).report.singular);
}

TEST(TensorInvolved, WhatBondsLackIsANullLagrangian)
{
  const RandomSolid<3> solid(5);
  const auto           n = TensorInvolved<3>::micromodulus_defect(solid.stiffness);
  const auto           s = TensorInvolved<3>::symmetrised(solid.stiffness);
  for (int i = 0; i < 3; ++i)
    for (int p = 0; p < 3; ++p)
      for (int k = 0; k < 3; ++k)
        for (int q = 0; q < 3; ++q)
          {
            // No force from second gradients, which are symmetric in p and q; together with S it is C.
            EXPECT_NEAR(n[i][p][k][q], -n[i][q][k][p], 1e-15);
            EXPECT_NEAR(n[i][p][k][q] + s[i][k][p][q], solid.stiffness[i][p][k][q], 1e-14);
          }
}

TEST(Lattice, UnstableRangesAreThoseOfTheory)
{
  const auto plate = [](const double nu, const double horizon_factor) {
    TensorInvolved<2> model(TensorInvolved<2>::Moments::sphere, 1.);
    return smallest_wave_stiffness<2>(
      model, ElasticConstants{1., nu, PlaneAssumption::plane_strain}, horizon_factor);
  };
  EXPECT_GT(plate(0.40, 2.), 0.);
  EXPECT_LT(plate(0.45, 2.), 0.);
  EXPECT_GT(plate(0.49, 3.), 0.);
  const auto block = [](const double nu, const double horizon_factor) {
    TensorInvolved<3> model(TensorInvolved<3>::Moments::sphere, 1.);
    return smallest_wave_stiffness<3>(
      model, ElasticConstants{1., nu, PlaneAssumption::solid}, horizon_factor);
  };
  EXPECT_GT(block(0.46, 3.), 0.);
  EXPECT_LT(block(0.48, 3.), 0.);
  EXPECT_GT(block(0.48, 4.), 0.);
}

TEST(Lattice, BondsPushSidewaysAboveTheirOwnPoissonRatio)
{
  const auto stiffness = [](const double nu) {
    TensorInvolved<2> model(TensorInvolved<2>::Moments::sphere, 1.);
    return smallest_bond_stiffness<2>(model, ElasticConstants{1., nu, PlaneAssumption::plane_stress}, 3.);
  };
  // Table (34): across to along a bond as (3 - 9 nu) to (15 + 3 nu), both over 2.
  EXPECT_NEAR(stiffness(0.22), (3 - 9 * 0.22) / (15 + 3 * 0.22), 1e-13);
  EXPECT_NEAR(stiffness(0.4), (3 - 9 * 0.4) / (15 + 3 * 0.4), 1e-13);
}

TEST(Lattice, AnisotropyOfSprings)
{
  // Neighbours along the mesh at 1 and 2, and the diagonal ones: 2 + 4/(2 sqrt 2) + 4 against 4/(2 sqrt 2).
  EXPECT_NEAR(lattice_anisotropy<2>(2.01), (6. + std::sqrt(2.)) / (3. * std::sqrt(2.)) - 1., 1e-13);
  // Round families come near the sphere; one of nearest neighbours has no shear stiffness.
  EXPECT_LT(std::abs(lattice_anisotropy<2>(12.)), 0.02);
  EXPECT_LT(std::abs(lattice_anisotropy<3>(8.)), 0.02);
  EXPECT_FALSE(std::isfinite(lattice_anisotropy<2>(1.01)));
}
