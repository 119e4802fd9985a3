// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/extended_ordinary.h>
#include <perideal/materials/influence_function.h>
#include <perideal/materials/moment_conditions.h>

#include "bodies.h"
#include "testing.h"

#include <numeric>

using namespace perideal;

namespace
{
  template <int dim>
  FamilyView<dim> view(const Families<dim> &families, const LocalIndex i)
  {
    FamilyView<dim> family;
    family.reinit(families, i);
    return family;
  }

  /// Dilatation and deviatoric energy sum wd (e^d)^2 V of a uniform strain.
  template <int dim>
  std::pair<double, double> measure(const FamilyView<dim>                 &family,
                                    const std::vector<double>             &wh,
                                    const std::vector<double>             &wd,
                                    const dealii::SymmetricTensor<2, dim> &strain)
  {
    std::vector<double> stretch(family.size);
    double              theta = 0, energy = 0;
    for (LocalIndex k = 0; k < family.size; ++k)
      {
        dealii::Tensor<1, dim> xi;
        for (int d = 0; d < dim; ++d)
          xi[d] = family.bond[d][k];
        stretch[k] = xi * (strain * xi) / std::sqrt(family.length_square[k]);
        theta += wh[k] * std::sqrt(family.length_square[k]) * stretch[k] * family.volume[k];
      }
    for (LocalIndex k = 0; k < family.size; ++k)
      {
        const double deviatoric = stretch[k] - theta * std::sqrt(family.length_square[k]) / dim;
        energy += wd[k] * deviatoric * deviatoric * family.volume[k];
      }
    return {theta, energy};
  }

  /// Uniform strain is exact in every family that is not reported, and such
  /// families exist.
  template <int dim>
  void expect_exact_energy(const typename ExtendedOrdinary<dim>::Form form,
                           const std::string                         &influence,
                           const double                               allowed_share_of_singular)
  {
    for (const auto &mesh : test::make_boxes<dim>())
      {
        const test::Body<dim> body(*mesh);
        ExtendedOrdinary<dim> model(form, InfluenceFunction(influence), 1.);
        std::vector<double>   wh, wd;
        unsigned int          n_singular = 0;
        for (LocalIndex i = 0; i < body.nodes.size(); ++i)
          {
            const auto         family = view(*body.families, i);
            const FamilyReport report = model.weigh(family, wh, wd);
            if (form == ExtendedOrdinary<dim>::Form::energy)
              {
                EXPECT_GE(*std::min_element(wd.begin(), wd.end()),
                          -1e-12 * *std::max_element(wd.begin(), wd.end()));
              }
            if (report.singular)
              {
                ++n_singular;
                continue;
              }
            for (unsigned int seed = 0; seed < 3; ++seed)
              {
                dealii::SymmetricTensor<2, dim> strain;
                for (unsigned int k = 0; k < strain.n_independent_components; ++k)
                  strain.access_raw_entry(k) = test::scatter(body.nodes.position[i], 10 * seed + k);
                const auto   measured = measure(family, wh, wd, strain);
                const double exact    = std::pow(deviator(strain).norm(), 2);
                EXPECT_NEAR(measured.first, trace(strain), 1e-11);
                EXPECT_NEAR(measured.second, exact, 1e-11 * std::max(1., exact));
              }
          }
        EXPECT_LE(n_singular, allowed_share_of_singular * body.nodes.size()) << influence;
      }
  }
} // namespace

TEST(InfluenceFunction, WeightedVolumesInClosedForm)
{
  // int_0^d r^3 2 pi dr, int_0^d r^4 4 pi dr; 1/s lowers the power by one.
  const double pi = dealii::numbers::PI, d = 1.7;
  EXPECT_NEAR(InfluenceFunction("constant").weighted_volume<2>(d), pi / 2 * std::pow(d, 4), 1e-12);
  EXPECT_NEAR(InfluenceFunction("constant").weighted_volume<3>(d), 4 * pi / 5 * std::pow(d, 5), 1e-11);
  EXPECT_NEAR(InfluenceFunction("inverse").weighted_volume<2>(d), 2 * pi / 3 * std::pow(d, 4), 1e-12);
  EXPECT_NEAR(InfluenceFunction("inverse").weighted_volume<3>(d), pi * std::pow(d, 5), 1e-11);
  // Gauss: int_0^1 exp(-4 s^2) s^3 ds = (1 - 5 exp(-4))/32.
  EXPECT_NEAR(InfluenceFunction("gaussian").weighted_volume<2>(d),
              2 * pi * (1 - 5 * std::exp(-4.)) / 32 * std::pow(d, 4),
              1e-12);
  // Spline: against the midpoint rule.
  double    sum = 0;
  const int n   = 2000;
  for (int k = 0; k < n; ++k)
    {
      const double s = (k + 0.5) / n;
      sum += InfluenceFunction("cubic spline").value(s, 1., 1.) * s * s * s / n;
    }
  EXPECT_NEAR(InfluenceFunction("cubic spline").weighted_volume<2>(d), 2 * pi * sum * std::pow(d, 4), 1e-6);
}

TEST(InfluenceFunction, FadingOnesReachTheBondsHorizon)
{
  EXPECT_GT(InfluenceFunction("cubic spline").value(1.5, 1., 2.), 0.);
  EXPECT_EQ(InfluenceFunction("cubic spline").value(2., 1., 2.), 0.);
  EXPECT_EQ(InfluenceFunction("constant").value(1.5, 1., 2.), 1.);
  EXPECT_EQ(InfluenceFunction("inverse").value(2., 1., 2.), 0.5);
}

TEST(MomentConditions, UniformStrainIsExact2D)
{
  for (const std::string influence : {"constant", "inverse", "gaussian", "cubic spline"})
    {
      expect_exact_energy<2>(ExtendedOrdinary<2>::Form::paper, influence, 0.);
      // The quarter discs at the four corners have no non-negative weights.
      expect_exact_energy<2>(ExtendedOrdinary<2>::Form::energy, influence, 4. / 40);
    }
}

TEST(MomentConditions, UniformStrainIsExact3D)
{
  for (const std::string influence : {"constant", "gaussian"})
    {
      expect_exact_energy<3>(ExtendedOrdinary<3>::Form::paper, influence, 0.);
      // Corner families of so small a block have no non-negative weights.
      expect_exact_energy<3>(ExtendedOrdinary<3>::Form::energy, influence, 0.6);
    }
}

TEST(MomentConditions, ThinPlatesAreReportedSingular)
{
  // One layer of cells: no bond leaves the plane, eps_zz cannot be seen.
  const auto          mesh = test::make_box<3>({6, 6, 1}, {1., 1., 1. / 6}, 0.);
  const test::Body<3> body(*mesh);
  ExtendedOrdinary<3> model(ExtendedOrdinary<3>::Form::energy, InfluenceFunction("constant"), 1.);
  std::vector<double> wh, wd;
  for (LocalIndex i = 0; i < body.nodes.size(); ++i)
    EXPECT_TRUE(model.weigh(view(*body.families, i), wh, wd).singular);
}

TEST(MomentConditions, RoundingOfCoordinatesIsNoThickness)
{
  const auto          mesh = test::make_box<3>({6, 6, 1}, {1., 1., 1. / 6}, 0.);
  const test::Body<3> plane(*mesh);
  dealii::GridTools::transform(
    [](const dealii::Point<3> &vertex) {
      dealii::Point<3> moved = vertex;
      moved[2] += 1e-15 * test::scatter(vertex, 2);
      return moved;
    },
    mesh->triangulation);
  const test::Body<3> rounded(*mesh);
  ExtendedOrdinary<3> model(ExtendedOrdinary<3>::Form::energy, InfluenceFunction("constant"), 1.);
  std::vector<double> wh, wd, rounded_wh, rounded_wd;
  for (LocalIndex i = 0; i < plane.nodes.size(); ++i)
    {
      model.weigh(view(*plane.families, i), wh, wd);
      EXPECT_TRUE(model.weigh(view(*rounded.families, i), rounded_wh, rounded_wd).singular);
      for (std::size_t k = 0; k < wh.size(); ++k)
        {
          EXPECT_NEAR(rounded_wh[k], wh[k], 1e-9 * std::abs(wh[k]) + 1e-9);
          EXPECT_NEAR(rounded_wd[k], wd[k], 1e-9 * std::abs(wd[k]) + 1e-9);
        }
    }
}

TEST(MomentConditions, ThicknessLeavesTheAnswerAlone)
{
  const auto          mesh = test::make_box<2>({7, 7}, {1., 1.}, 0.2);
  const test::Body<2> thin(*mesh);
  mesh->thickness = 0.01;
  const test::Body<2> scaled(*mesh);
  ExtendedOrdinary<2> one(ExtendedOrdinary<2>::Form::energy, InfluenceFunction("constant"), 1.),
    hundredth(ExtendedOrdinary<2>::Form::energy, InfluenceFunction("constant"), 0.01);
  std::vector<double> wh, wd, scaled_wh, scaled_wd;
  for (LocalIndex i = 0; i < thin.nodes.size(); ++i)
    {
      one.weigh(view(*thin.families, i), wh, wd);
      hundredth.weigh(view(*scaled.families, i), scaled_wh, scaled_wd);
      for (std::size_t k = 0; k < wh.size(); ++k)
        {
          EXPECT_NEAR(scaled_wh[k] * 0.01, wh[k], 1e-10 * std::abs(wh[k]) + 1e-12);
          EXPECT_NEAR(scaled_wd[k] * 0.01, wd[k], 1e-9 * std::abs(wd[k]) + 1e-9);
        }
    }
}
