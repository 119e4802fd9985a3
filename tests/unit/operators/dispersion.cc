// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/parameters/elastic_constants.h>

#include "bodies.h"
#include "dense_matrix.h"
#include "moments.h"
#include "testing.h"

#include <Eigen/Eigenvalues>

#include <cmath>

using namespace perideal;

namespace
{
  /// Phase speeds of plane waves in squares and cubes of the consistent form, over those of the solid.
  template <int dim>
  class PlaneWaves
  {
  public:
    PlaneWaves()
      : mesh(make_mesh())
      , body(*mesh, 2.01)
      , constants{70e9, 0.25, dim == 2 ? PlaneAssumption::plane_strain : PlaneAssumption::solid}
    {
      bonds = test::make_moving_operator<dim>(
        *mesh, body.nodes, body.families, 2.01, [this](const auto) { return ElasticSolid<dim>(constants); });
      bonds->initialize(force);
      bonds->initialize(displacement);
      for (int d = 0; d < dim; ++d)
        middle[d] = 0.5 * n_cells;
    }

    /// Speeds, from the slowest on, each over that of its wave in the solid.
    Eigen::VectorXd speeds(const dealii::Tensor<1, dim> &direction, const double cells_a_wave)
    {
      const double    wave_number = 2. * dealii::numbers::PI / cells_a_wave;
      Eigen::MatrixXd stiffness(dim, dim);
      for (int b = 0; b < dim; ++b)
        {
          displacement = 0.;
          for (LocalIndex i = 0; i < body.nodes.size(); ++i)
            displacement.local_element(dim * i + b) =
              std::cos(wave_number * (direction * (body.nodes.position[i] - middle)));
          bonds->vmult(force, displacement);
          for (LocalIndex i = 0; i < body.nodes.size(); ++i)
            if (body.nodes.position[i].distance(middle) < 1e-9)
              for (int a = 0; a < dim; ++a)
                stiffness(a, b) = force.local_element(dim * i + a);
        }
      // Cells and density are one: eigenvalues are squares of frequencies.
      Eigen::VectorXd result =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(stiffness, Eigen::EigenvaluesOnly).eigenvalues();
      const double shear = constants.shear_modulus();
      for (int k = 0; k < dim; ++k)
        {
          const double modulus = k < dim - 1 ? shear : 2. * shear * (1. - 0.25) / (1. - 0.5);
          result[k]            = std::sqrt(result[k] / modulus) / wave_number;
        }
      return result;
    }

  private:
    /// Cells of one in each direction, more than the operator reaches around the one in the middle.
    static std::unique_ptr<Mesh<dim>> make_mesh()
    {
      dealii::Point<dim> size;
      for (int d = 0; d < dim; ++d)
        size[d] = n_cells;
      return test::make_box<dim>(std::vector<unsigned int>(dim, n_cells), size, 0., MPI_COMM_SELF);
    }

    static constexpr unsigned int            n_cells = 13;
    std::unique_ptr<Mesh<dim>>               mesh;
    test::Body<dim>                          body;
    ElasticConstants                         constants;
    std::shared_ptr<ConsistentOperator<dim>> bonds;
    NodalVector                              force, displacement;
    dealii::Point<dim>                       middle;
  };

  /// Of fourth order in regular bodies: the energy form is 2.2, 6 and 13 % off.
  template <int dim>
  void expect_phase_speeds()
  {
    PlaneWaves<dim>                     waves;
    std::vector<dealii::Tensor<1, dim>> directions;
    for (int degrees = 0; degrees <= 45; degrees += 15)
      {
        dealii::Tensor<1, dim> in_plane;
        in_plane[0] = std::cos(degrees * dealii::numbers::PI / 180.);
        in_plane[1] = std::sin(degrees * dealii::numbers::PI / 180.);
        directions.push_back(in_plane);
        if constexpr (dim == 3)
          for (const double rise : {0.4, 0.7071067811865476, 1.2})
            {
              dealii::Tensor<1, dim> risen = in_plane;
              risen[2]                     = rise;
              directions.push_back(risen / risen.norm());
            }
      }
    const std::array<double, 3> cells = {{20., 12., 8.}}, off = {{0.001, 0.004, 0.015}};
    for (unsigned int k = 0; k < cells.size(); ++k)
      for (const auto &direction : directions)
        {
          const Eigen::VectorXd speeds = waves.speeds(direction, cells[k]);
          for (int mode = 0; mode < dim; ++mode)
            EXPECT_NEAR(speeds[mode], 1., off[k]) << cells[k] << " cells a wave, direction " << direction;
        }
    // The error falls with the fourth power of the number of cells.
    const double coarse = waves.speeds(directions[1], 12.)[0] - 1.,
                 fine   = waves.speeds(directions[1], 24.)[0] - 1.;
    EXPECT_GE(std::abs(coarse / fine), 12.);
  }

  /// Largest frequency of a free body of density one.
  template <int dim>
  double largest_frequency(const BondOperator<dim> &bonds, const std::vector<double> &volumes)
  {
    dealii::FullMatrix<double> stiffness = test::dense_matrix(bonds);
    for (unsigned int r = 0; r < stiffness.m(); ++r)
      for (unsigned int c = 0; c < stiffness.n(); ++c)
        stiffness(r, c) /= std::sqrt(volumes[r / dim] * volumes[c / dim]);
    dealii::LAPACKFullMatrix<double> matrix(stiffness.m());
    matrix = stiffness;
    dealii::Vector<double>     values;
    dealii::FullMatrix<double> vectors;
    matrix.compute_eigenvalues_symmetric(-1., 1e30, 0., values, vectors);
    return std::sqrt(values[values.size() - 1]);
  }

  /// Stable steps of the consistent form over those of the energy form with its longer bonds, surfaces
  /// included.
  template <int dim>
  void expect_stable_step(const unsigned int n_cells, const double distortion, const double least)
  {
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = 1.;
    const auto mesh =
      test::make_box<dim>(std::vector<unsigned int>(dim, n_cells), size, distortion, MPI_COMM_SELF);
    const ElasticConstants constants{
      70e9, 0.25, dim == 2 ? PlaneAssumption::plane_strain : PlaneAssumption::solid};
    const auto      solid_of = [&](const auto) { return ElasticSolid<dim>(constants); };
    ModelParameters of_bonds;
    test::Body<dim> near(*mesh, 2.01), far(*mesh, 3.01);
    of_bonds.form = "energy";
    of_bonds.resolve(dim, ModelParameters::Use::motion, true);
    const double of_consistent = largest_frequency<dim>(
      *test::make_moving_operator<dim>(*mesh, near.nodes, near.families, 2.01, solid_of), near.nodes.volume);
    const double of_energy = largest_frequency<dim>(
      *create_bond_operator<dim>(far.families, *create_model<dim>(of_bonds, 1.), solid_of), far.nodes.volume);
    EXPECT_GE(of_energy / of_consistent, least);
  }
} // namespace

TEST(Dispersion, StableStepOverThatOfTheEnergyForm)
{
  expect_stable_step<2>(12, 0., 0.30);
  expect_stable_step<2>(12, 0.3, 0.27);
  expect_stable_step<3>(6, 0., 0.30);
  expect_stable_step<3>(6, 0.3, 0.29);
}

TEST(Dispersion, PhaseSpeedsOfPlaneWaves2D)
{
  expect_phase_speeds<2>();
}
TEST(Dispersion, PhaseSpeedsOfPlaneWaves3D)
{
  expect_phase_speeds<3>();
}
