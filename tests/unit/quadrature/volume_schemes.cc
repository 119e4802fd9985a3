// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/geometry/cell_in_ball.h>
#include <perideal/materials/bond_based.h>
#include <perideal/quadrature/bond_volume.h>

#include "bodies.h"
#include "springs.h"
#include "testing.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

using namespace perideal;
using dealii::numbers::PI;

namespace
{
  template <int dim>
  double ball(const double radius)
  {
    return dim == 2 ? PI * radius * radius : 4 * PI / 3 * std::pow(radius, 3);
  }

  /// What the family of the node in the middle of a grid counts of its horizon, with its own cell.
  template <int dim>
  double counted_ball(const unsigned int factor, const std::string &name)
  {
    const unsigned int n = 2 * factor + 3;
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = n;
    const auto mesh = test::make_box<dim>(std::vector<unsigned int>(dim, n), size, 0., MPI_COMM_SELF);
    const test::Body<dim> body(*mesh, factor, "sphere", name);
    const Families<dim>  &families = *body.families;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (families.position[i].distance(0.5 * size) < 0.1)
        {
          double volume = families.volume[i];
          for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
            volume += counted_volume(families, i, *j);
          return volume;
        }
    return 0;
  }

  /// Largest relative error of the strain energy of a bond-based node inside a grid, over expansion, tension
  /// and shear.
  template <int dim>
  double worst_energy_error(const double factor, const std::string &name)
  {
    const unsigned int n = 2 * static_cast<int>(factor) + 5;
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = n;
    const auto mesh = test::make_box<dim>(std::vector<unsigned int>(dim, n), size, 0., MPI_COMM_SELF);
    const test::Body<dim> body(*mesh, factor, "sphere", name);
    LocalIndex            middle = 0;
    while (body.nodes.position[middle].distance(0.5 * size) > 0.1)
      ++middle;
    const double       kappa = 2., mu = dim == 2 ? kappa / 2 : 3 * kappa / 5; // nu = 1/3, 1/4
    FamilyView<dim>    view;
    FamilyCoefficients coefficients;
    BondBased<dim>     model(1.);
    view.reinit(*body.families, middle);
    view.bulk_modulus = kappa;
    coefficients.resize(view.size, model.shape());
    model.compute(view, coefficients);
    dealii::Tensor<2, dim> strains[3];
    for (int d = 0; d < dim; ++d)
      strains[0][d][d] = 1.;
    strains[1][0][0] = strains[2][0][1] = strains[2][1][0] = 1.;
    double worst                                           = 0;
    for (const auto &strain : strains)
      {
        const double energy   = test::spring_energy<dim>(view, coefficients, strain);
        const double trace_of = trace(strain);
        const double exact =
          0.5 * kappa * trace_of * trace_of + mu * (strain.norm_square() - trace_of * trace_of / dim);
        worst = std::max(worst, std::abs(energy / exact - 1));
      }
    return worst;
  }

  /// The same on a lattice that is not built.
  double counted_ball_of_lattice(const int factor, const bool cuts_off)
  {
    double volume = 0;
    for (int k = -factor - 1; k <= factor + 1; ++k)
      for (int j = -factor - 1; j <= factor + 1; ++j)
        for (int i = -factor - 1; i <= factor + 1; ++i)
          if (const int square = i * i + j * j + k * k; !cuts_off || square <= factor * factor)
            volume += linear_share(factor, 1., std::sqrt(square));
    return volume;
  }

  /// Families of the closed form hold all cells that horizons cut and no other, wherever they are.
  template <int dim>
  void expect_exact_families(const Mesh<dim> &mesh)
  {
    const test::Body<dim> body(mesh, 2.2, "sphere", "exact");
    const auto           &families = *body.families;
    struct Other
    {
      CellVertices<dim>  cell;
      dealii::Point<dim> position;
      double             horizon;
    };
    std::vector<CellVertices<dim>>  cells;
    std::vector<dealii::Point<dim>> positions;
    std::vector<double>             horizons;
    const auto                      gather = [&](const auto &own, auto &all) {
      for (const auto &part : dealii::Utilities::MPI::all_gather(body.nodes.communicator, own))
        all.insert(all.end(), part.begin(), part.end());
    };
    gather(body.nodes.cell, cells);
    gather(body.nodes.position, positions);
    gather(body.nodes.horizon, horizons);
    const auto share = [&](const GlobalIndex i, const GlobalIndex j) {
      return volume_in_ball<dim>(cells[j], positions[i], horizons[i]) / cell_volume<dim>(cells[j]);
    };
    FamilyView<dim> view;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        const GlobalIndex        self = families.global_number(i);
        std::vector<GlobalIndex> expected, found;
        for (GlobalIndex j = 0; j < cells.size(); ++j)
          if (j != self &&
              (share(self, j) > VolumeRule<dim>::negligible || share(j, self) > VolumeRule<dim>::negligible))
            expected.push_back(j);
        for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
          {
            const GlobalIndex other = families.global_number(*j);
            found.push_back(other);
            // Ghosts know their cells. Boxes may be remembered, to 1e-11.
            EXPECT_NEAR(volume_share(families, i, *j), share(self, other), 1e-10);
            EXPECT_NEAR(volume_share(families, *j, i), share(other, self), 1e-10);
          }
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, expected);

        view.reinit(families, i);
        double volume = 0, expected_volume = 0;
        for (LocalIndex k = 0; k < view.size; ++k)
          volume += view.volume[k];
        for (const GlobalIndex j : expected)
          expected_volume += share(self, j) * cell_volume<dim>(cells[j]);
        EXPECT_NEAR(volume, expected_volume, 1e-9 * expected_volume);
      }
  }

  /// Inside a mesh of any cells, a family and its node count the whole horizon.
  template <int dim>
  void expect_whole_horizons(const Mesh<dim>          &mesh,
                             const dealii::Point<dim> &size,
                             const std::string        &scheme,
                             const double              tolerance)
  {
    const test::Body<dim> body(mesh, 2.2, "sphere", scheme);
    const auto           &families = *body.families;
    double                n_inside = 0;
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        const double radius = families.horizon[i];
        bool         inside = true;
        for (int d = 0; d < dim; ++d)
          inside = inside && families.position[i][d] > radius && size[d] - families.position[i][d] > radius;
        if (!inside)
          continue;
        ++n_inside;
        double volume = families.volume[i];
        for (const LocalIndex *j = families.begin(i); j != families.end(i); ++j)
          volume += counted_volume(families, i, *j);
        EXPECT_NEAR(volume, ball<dim>(radius), tolerance * volume);
      }
    EXPECT_GT(dealii::Utilities::MPI::sum(n_inside, MPI_COMM_WORLD), 0.);
  }
} // namespace

/// K. Yu's thesis, Table 2.2, column CCI, and what becomes of it when cells beyond count too.
TEST(VolumeSchemes, SpheresOfCubicCells)
{
  const std::vector<int>    factors = {3, 4, 5, 6, 8, 9, 10, 15, 20, 30};
  const std::vector<double> printed = {7.992, 10.525, 7.966, 4.891, 5.367, 3.773, 3.862, 2.415, 2.028, 1.251};
  const std::vector<double> all     = {3.320, 1.192, 1.193, .481, .384, .158, .347, .165, .048, .019};
  for (std::size_t k = 0; k < factors.size(); ++k)
    {
      const int  m     = factors[k];
      const auto error = [&](const double volume) { return 100 * std::abs(volume / ball<3>(m) - 1); };
      // As printed, to half a unit of the last digit.
      EXPECT_NEAR(error(counted_ball_of_lattice(m, true)), printed[k], 0.0006) << m;
      EXPECT_NEAR(error(counted_ball_of_lattice(m, false)), all[k], 0.0006) << m;
      if (m <= 4)
        {
          EXPECT_NEAR(error(counted_ball<3>(m, "cubic cell")), printed[k], 0.0006) << m;
          EXPECT_NEAR(error(counted_ball<3>(m, "partial volume")), all[k], 0.0006) << m;
        }
    }
}

TEST(VolumeSchemes, SpheresOfExactCells)
{
  for (const unsigned int m : {3, 4})
    {
      EXPECT_NEAR(counted_ball<3>(m, "exact"), ball<3>(m), 1e-9 * ball<3>(m));
      EXPECT_NEAR(counted_ball<2>(m, "exact"), ball<2>(m), 1e-9 * ball<2>(m));
      // Default tolerances: 1e-6 of a share, or of the cell where the share is below 1e-4.
      EXPECT_NEAR(counted_ball<3>(m, "adaptive"), ball<3>(m), 1e-6 * ball<3>(m));
    }
}

TEST(VolumeSchemes, FamiliesHoldTheCellsThatHorizonsCut)
{
  for (const auto &mesh : test::make_boxes<2>())
    expect_exact_families<2>(*mesh);
  for (const auto &mesh : test::make_boxes<3>())
    expect_exact_families<3>(*mesh);
}

TEST(VolumeSchemes, WholeHorizonsInDistortedMeshes)
{
  const auto squares = test::make_box<2>({9, 8}, {1., 1.}, 0.3);
  expect_whole_horizons<2>(*squares, {1., 1.}, "exact", 1e-10);
  // The default tolerance of integration.
  expect_whole_horizons<2>(*squares, {1., 1.}, "adaptive", 1e-6);
  const auto cubes = test::make_box<3>({7, 7, 7}, {1., 1., 1.}, 0.2);
  expect_whole_horizons<3>(*cubes, {1., 1., 1.}, "exact", 1e-10);
}

/// Nodes at the rim count with half their cells.
TEST(VolumeSchemes, CubicCellsCountNodesWithinTheHorizon)
{
  const auto          mesh = test::make_box<2>({11, 11}, {1.1, 1.1}, 0.);
  const test::Body<2> body(*mesh, 3., "sphere", "cubic cell");
  // 28 nodes within 3 spacings, of which 4 are at the rim with half their volume.
  EXPECT_EQ(body.families->statistics().max, 28u);
  unsigned int n_halves = 0, n = 0;
  for (LocalIndex i = 0; i < body.families->n_owned(); ++i)
    for (const LocalIndex *j = body.families->begin(i); j != body.families->end(i); ++j, ++n)
      if (std::abs(body.families->position[i].distance(body.families->position[*j]) - 0.3) < 1e-9)
        {
          EXPECT_NEAR(volume_share(*body.families, i, *j), 0.5, 1e-9);
          ++n_halves;
        }
  EXPECT_TRUE(n_halves > 0 || body.families->n_owned() == 0);
  EXPECT_GE(n, n_halves);
}

/// Measured: 5.3, 8.0 and 21.8 % with one point; 13.3, 12.6 and 13.5 % with cubic cells, 3.3, 1.8 and 7.0 %
/// with partial volumes, 2.2, 1.1 and 2.2 % with exact ones. What is left is that bonds end at nodes, not
/// where the parts lie.
TEST(VolumeSchemes, EnergyOfUniformStrain)
{
  const auto errors = [](const std::string &scheme) {
    return std::vector<double>{worst_energy_error<2>(3., scheme),
                               worst_energy_error<2>(4.01, scheme),
                               worst_energy_error<3>(3., scheme)};
  };
  const auto cubic = errors("cubic cell"), linear = errors("partial volume"), exact = errors("exact"),
             adaptive = errors("adaptive");
  for (unsigned int k = 0; k < exact.size(); ++k)
    {
      EXPECT_LT(exact[k], 0.023);
      EXPECT_LT(exact[k], 0.7 * linear[k]);
      EXPECT_LT(linear[k], 0.6 * cubic[k]);
      // The tolerance of integration.
      EXPECT_NEAR(adaptive[k], exact[k], 1e-6);
    }
}
