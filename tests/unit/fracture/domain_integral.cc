// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/domain_integral.h>
#include <perideal/neighbourhood/precrack.h>
#include <perideal/reconstruction/family_quadratics.h>

#include "bodies.h"

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iomanip>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

using namespace perideal;

namespace
{
  const double pi = dealii::numbers::PI;

  ElasticSolid<2> steel(const PlaneAssumption assumption)
  {
    return ElasticSolid<2>(ElasticConstants{210e9, 0.3, assumption});
  }

  /// A crack that ends near the middle of a unit square, at an angle to the grid, and fields of both modes.
  struct CrackedSquare
  {
    CrackedSquare(const unsigned int n, const double angle, const PlaneAssumption assumption)
      : mesh(test::make_box<2>({n, n}, {1., 1.}, 0.))
      , body(*mesh)
      , solid(steel(assumption))
    {
      tip.position             = {0.5, 0.5};
      tip.direction            = dealii::Tensor<1, 2>({std::cos(angle), std::sin(angle)});
      const auto         mouth = tip.position - 2. * tip.direction;
      std::ostringstream text;
      text << std::setprecision(17) << mouth[0] << ',' << mouth[1] << "; 0.5, 0.5";
      crack.emplace(PrecrackText{"c", text.str()}, *mesh);
    }

    /// Nodes on the line of the crack are on the side on which it leaves their bonds.
    DomainIntegral::Side side_of(const dealii::Point<2> &point) const
    {
      const dealii::Tensor<1, 2> left({-tip.direction[1], tip.direction[0]});
      if (std::abs((point - tip.position) * left) > 1e-9)
        return DomainIntegral::Side::automatic;
      return crack->crosses(point, point + 0.01 * left) ? DomainIntegral::Side::right :
                                                          DomainIntegral::Side::left;
    }

    double angle_of(const dealii::Point<2> &point) const
    {
      const auto   offset = point - tip.position;
      const double angle =
        std::atan2(tip.direction[0] * offset[1] - tip.direction[1] * offset[0], tip.direction * offset);
      const auto side = side_of(point);
      return side == DomainIntegral::Side::automatic ?
               angle :
               std::copysign(angle, side == DomainIntegral::Side::left ? 1. : -1.);
    }

    dealii::Tensor<2, 2> axes() const
    {
      dealii::Tensor<2, 2> result;
      result[0] = dealii::Tensor<1, 2>({tip.direction[0], -tip.direction[1]});
      result[1] = dealii::Tensor<1, 2>({tip.direction[1], tip.direction[0]});
      return result;
    }

    /// Gradients of nodal values of the field, from families that the crack cuts.
    std::vector<dealii::Tensor<2, 2>> fitted(const std::array<double, 2> &K) const
    {
      const Families<2>      &families = *body.families;
      NodalVector             field(families.make_partitioner(2));
      std::vector<LocalIndex> nodes;
      for (LocalIndex i = 0; i < families.n_owned(); ++i)
        {
          dealii::Tensor<1, 2> u;
          for (const unsigned int mode : {0, 1})
            u += K[mode] * (axes() * unit_intensity_displacement(mode,
                                                                 families.position[i].distance(tip.position),
                                                                 angle_of(families.position[i]),
                                                                 solid.isotropic()));
          for (const unsigned int d : {0, 1})
            field.local_element(2 * i + d) = u[d];
          nodes.push_back(i);
        }
      field.update_ghost_values();
      FamilyQuadratics<2> fit(families, field, nodes);
      for (const LocalIndex i : nodes)
        for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
          if (!crack->crosses(families.position[i], families.position[*j]))
            fit.add(i, *j);
      return fit.gradients();
    }

    /// The exact gradients at the nodes.
    std::vector<dealii::Tensor<2, 2>> exact(const std::array<double, 2> &K) const
    {
      std::vector<dealii::Tensor<2, 2>> result;
      for (const auto &point : body.nodes.position)
        {
          dealii::Tensor<2, 2> gradient;
          for (const unsigned int mode : {0, 1})
            gradient += K[mode] * unit_intensity_gradient(
                                    mode, point.distance(tip.position), angle_of(point), solid.isotropic());
          result.push_back(axes() * gradient * transpose(axes()));
        }
      return result;
    }

    CrackDrive
    drive(const std::vector<dealii::Tensor<2, 2>> &gradients, const double inner, const double outer) const
    {
      DomainIntegral integral(tip, inner, outer, solid);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        if (integral.contains(body.nodes.position[i]))
          {
            const dealii::SymmetricTensor<2, 2> strain = symmetrize(gradients[i]),
                                                stress = solid.stiffness() * strain;
            integral.add({body.nodes.position[i],
                          body.nodes.volume[i],
                          gradients[i],
                          stress,
                          0.5 * (stress * strain),
                          side_of(body.nodes.position[i])});
          }
      DomainIntegral::Sums sums;
      for (std::size_t k = 0; k < sums.size(); ++k)
        sums[k] = dealii::Utilities::MPI::sum(integral.sums()[k], MPI_COMM_WORLD);
      return integral.drive(sums);
    }

    std::unique_ptr<Mesh<2>>   mesh;
    test::Body<2>              body;
    ElasticSolid<2>            solid;
    PlaneTip                   tip;
    std::optional<Precrack<2>> crack;
  };

  void expect_intensity(const CrackDrive &drive, const std::array<double, 2> &K, const double tolerance)
  {
    const double size = std::hypot(K[0], K[1]);
    ASSERT_TRUE(drive.intensity);
    for (const unsigned int mode : {0, 1})
      EXPECT_NEAR((*drive.intensity)[mode], K[mode], tolerance * size);
  }
} // namespace

/// Gradients are those of the displacements.
TEST(UnitIntensity, GradientIsThatOfTheDisplacement)
{
  for (const auto assumption : {PlaneAssumption::plane_stress, PlaneAssumption::plane_strain})
    for (const unsigned int mode : {0, 1})
      for (const double angle : {-3.1, -1., 0.2, 2.9})
        {
          const ElasticConstants solid    = steel(assumption).isotropic();
          const double           distance = 0.3, step = 1e-6;
          const auto             at = [&](const double x, const double y) {
            return unit_intensity_displacement(mode, std::hypot(x, y), std::atan2(y, x), solid);
          };
          const double x = distance * std::cos(angle), y = distance * std::sin(angle);
          const auto   gradient = unit_intensity_gradient(mode, distance, angle, solid);
          const auto   by_x     = (at(x + step, y) - at(x - step, y)) / (2. * step),
                     by_y       = (at(x, y + step) - at(x, y - step)) / (2. * step);
          for (const unsigned int i : {0, 1})
            {
              EXPECT_NEAR(gradient[i][0], by_x[i], 1e-8 * gradient.norm());
              EXPECT_NEAR(gradient[i][1], by_y[i], 1e-8 * gradient.norm());
            }
        }
}

/// Ahead of the tip K/sqrt(2 pi r) opens or shears the line of the crack; its faces are free.
TEST(UnitIntensity, IsThatOfTheStressAhead)
{
  const ElasticSolid<2> solid = steel(PlaneAssumption::plane_strain);
  const double          r = 0.02, ahead = 1. / std::sqrt(2. * pi * r);
  for (const unsigned int mode : {0, 1})
    for (const double angle : {0., pi, -pi})
      {
        const dealii::SymmetricTensor<2, 2> stress =
          solid.stiffness() * symmetrize(unit_intensity_gradient(mode, r, angle, solid.isotropic()));
        EXPECT_NEAR(stress[1][1], angle == 0. && mode == 0 ? ahead : 0., 1e-12 * ahead);
        EXPECT_NEAR(stress[0][1], angle == 0. && mode == 1 ? ahead : 0., 1e-12 * ahead);
      }
}

/// The midpoint rule over cells of the exact fields.
TEST(DomainIntegral, TellsTheIntensityOfExactFields)
{
  const std::array<double, 2> K = {{2e6, -0.7e6}};
  for (const auto assumption : {PlaneAssumption::plane_stress, PlaneAssumption::plane_strain})
    for (const double angle : {0., std::atan(0.5)})
      {
        const CrackedSquare square(40, angle, assumption);
        const double        modulus = 210e9 / (assumption == PlaneAssumption::plane_stress ? 1. : 1. - 0.09);
        for (const double outer : {0.25, 0.45})
          {
            const CrackDrive drive = square.drive(square.exact(K), outer / 3., outer);
            // Cells are 1/10 and 1/18 of the radius; the rule is of second order.
            expect_intensity(drive, K, 3e-3);
            EXPECT_NEAR(
              drive.energy_release_rate, (K[0] * K[0] + K[1] * K[1]) / modulus, 4e-3 * 4.49e12 / modulus);
          }
      }
}

/// From nodal displacements of families that the crack cuts, along the grid and across it.
TEST(DomainIntegral, TellsTheIntensityOfNodalFields)
{
  for (const double angle : {0., std::atan(0.5), 0.25 * pi, pi})
    for (const auto &K : {std::array<double, 2>{{1e6, 0.}}, std::array<double, 2>{{1e6, 0.8e6}}})
      {
        const CrackedSquare square(40, angle, PlaneAssumption::plane_stress);
        const auto          gradients = square.fitted(K);
        // Radii of five and six horizons; measured 1.8e-3.
        for (const double outer : {0.375, 0.45})
          expect_intensity(square.drive(gradients, outer / 3., outer), K, 5e-3);
      }
}

/// Nothing drives a crack in a body that turns and stretches along the crack alone.
TEST(DomainIntegral, RotationAndStressAlongTheCrackDriveNothing)
{
  const CrackedSquare  square(20, 0., PlaneAssumption::plane_stress);
  dealii::Tensor<2, 2> gradient;
  gradient[0][0] = 1e-3;
  gradient[1][1] = -0.3e-3;
  gradient[0][1] = 2e-3;
  gradient[1][0] = -2e-3;
  const CrackDrive drive =
    square.drive(std::vector<dealii::Tensor<2, 2>>(square.body.nodes.size(), gradient), 0.15, 0.45);
  // Against the energy in the ring over its radius: by symmetry sums over cells cancel.
  EXPECT_NEAR(drive.energy_release_rate, 0., 1e-9 * 210e9 * 1e-6 * 0.45);
}

/// Anisotropic solids have G, but no such intensity.
TEST(DomainIntegral, AnisotropicSolidsHaveNoIntensity)
{
  dealii::SymmetricTensor<4, 3> stiffness = steel(PlaneAssumption::plane_strain).stiffness_in_space();
  stiffness[0][0][0][0] *= 2.;
  const ElasticSolid<2> solid(stiffness, PlaneAssumption::plane_strain);
  ASSERT_FALSE(solid.is_isotropic());
  const DomainIntegral integral({{0., 0.}, dealii::Tensor<1, 2>({1., 0.})}, 0.1, 0.3, solid);
  EXPECT_FALSE(integral.drive({{1., 1., 1.}}).intensity);
  EXPECT_EQ(integral.drive({{1., 1., 1.}}).energy_release_rate, 1.);
}
