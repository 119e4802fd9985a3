// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/boundary/boundary_faces.h>
#include <perideal/materials/models.h>
#include <perideal/operators/linear/consistent_operator.h>

#include "bodies.h"
#include "dense_matrix.h"
#include "moments.h"
#include "near_blocks.h"
#include "solids.h"
#include "testing.h"

using namespace perideal;

// Bodies two cells thick in the consistent form, where polynomials are closed (PolynomialClosure).

namespace
{
  template <int dim>
  std::unique_ptr<Mesh<dim>> make_layers(const std::vector<unsigned int> &cells,
                                         const double                     distortion,
                                         MPI_Comm                         communicator = MPI_COMM_WORLD)
  {
    // Cells twice as high as long, or the other way round.
    dealii::Point<dim> size;
    for (int d = 0; d < dim; ++d)
      size[d] = cells[d] * (d == dim - 1 ? (cells[0] > 6 ? 0.2 : 0.1) : d == 0 ? 0.1 : 0.15);
    return test::make_box<dim>(cells, size, distortion, communicator);
  }

  /// Layers of square and stretched, regular and distorted cells, in space bars of two by two, too.
  template <int dim>
  std::vector<std::unique_ptr<Mesh<dim>>> make_all_layers(MPI_Comm communicator = MPI_COMM_WORLD)
  {
    std::vector<std::unique_ptr<Mesh<dim>>> result;
    for (const double distortion : {0., 0.2})
      if constexpr (dim == 2)
        {
          result.push_back(make_layers<2>({6, 2}, distortion, communicator));
          result.push_back(make_layers<2>({11, 2}, distortion, communicator));
        }
      else
        {
          result.push_back(make_layers<3>({5, 4, 2}, distortion, communicator));
          result.push_back(make_layers<3>({7, 2, 2}, distortion, communicator));
        }
    return result;
  }

  /// A body whose left face is held along x and nowhere else, or free.
  template <int dim>
  struct Layers
  {
    Layers(const Mesh<dim> &mesh, const ElasticSolid<dim> &solid, const bool is_held)
      : body(mesh, 2.01)
    {
      ModelParameters parameters;
      parameters.resolve(dim);
      const auto polynomials = std::make_shared<const CellPolynomials<dim>>(
        mesh, body.nodes, [&](const auto) { return solid.stiffness(); });
      const auto faces =
        std::make_shared<const FaceMoments<dim>>(mesh, *polynomials, [](const auto) { return 1.; });
      LoadParameters text;
      text.conditions.resize(is_held ? 1 : 0);
      if (is_held)
        {
          text.conditions[0].name = text.conditions[0].boundary = "0";
          text.conditions[0].displacement[0]                    = "0";
        }
      const Loads<dim> loads  = resolve_boundaries(mesh, Loads<dim>(text));
      const auto       values = std::make_shared<FaceValues<dim>>(faces->boundary_points(), loads);
      values->set_time(loads, 1.);
      moments =
        std::make_shared<const GradientMoments<dim>>(polynomials, faces, values, body.nodes.communicator);
      bonds = test::make_consistent_operator<dim>(body.families,
                                                  moments,
                                                  create_consistent<dim>(parameters, 2.01),
                                                  [solid](const auto) { return solid; });
      bonds->initialize(displacement);
      bonds->initialize(force);
    }

    /// Means of a displacement without pattern.
    void displace(const unsigned int seed)
    {
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        for (int d = 0; d < dim; ++d)
          displacement.local_element(dim * i + d) =
            1e-3 * test::scatter(body.nodes.position[i], 5 * seed + d);
      bonds->vmult(force, displacement);
    }

    test::Body<dim>                             body;
    std::shared_ptr<const GradientMoments<dim>> moments;
    std::shared_ptr<ConsistentOperator<dim>>    bonds;
    NodalVector                                 displacement, force;
  };

  template <int dim>
  std::vector<ElasticSolid<dim>> solids()
  {
    const auto assumption = dim == 2 ? PlaneAssumption::plane_strain : PlaneAssumption::solid;
    return {ElasticConstants{70e9, 0.4, assumption}, test::solid_without_symmetry<dim>(assumption)};
  }

  /// Every body of every solid, held and free.
  template <int dim, typename Property>
  void for_all_layers(const Property &property)
  {
    const auto meshes = make_all_layers<dim>();
    for (std::size_t m = 0; m < meshes.size(); ++m)
      for (const auto &solid : solids<dim>())
        for (const bool is_held : {false, true})
          {
            SCOPED_TRACE("mesh " + std::to_string(m) + (is_held ? ", held" : ", free"));
            property(*meshes[m], solid, is_held);
          }
  }

  /// Bending with the stress (x.n) S along the body, which every cell has by its closed polynomial: the
  /// energy is that of the solid.
  template <int dim>
  void expect_exact_bending()
  {
    for_all_layers<dim>([](const Mesh<dim> &mesh, const ElasticSolid<dim> &solid, const bool is_held) {
      if (is_held)
        return;
      Layers<dim>                     layers(mesh, solid, false);
      dealii::SymmetricTensor<2, dim> stress;
      stress[0][0]       = 1e6;
      const auto  strain = invert(solid.stiffness()) * stress;
      const auto &cells  = layers.moments->cell_polynomials();
      double      energy = 0;
      EXPECT_EQ(cells.closure().cells().size(), layers.body.nodes.size());
      for (LocalIndex i = 0; i < layers.body.nodes.size(); ++i)
        {
          const auto &x      = cells.centroids()[i];
          const auto  square = cells.second_moments()[i] + symmetrize(outer_product(x, x));
          energy += 0.5 * cells.volumes()[i] * square[dim - 1][dim - 1] * (stress * strain);
          // d_k d_l u_a = n_l eps_ak + n_k eps_al - n_a eps_kl.
          for (int a = 0; a < dim; ++a)
            {
              double sum = 0;
              for (int k = 0; k < dim; ++k)
                sum += 2. * strain[a][k] * square[k][dim - 1];
              if (a == dim - 1)
                sum -= strain * square;
              layers.displacement.local_element(dim * i + a) = 0.5 * sum;
            }
        }
      layers.bonds->vmult(layers.force, layers.displacement);
      energy = dealii::Utilities::MPI::sum(energy, MPI_COMM_WORLD);
      EXPECT_NEAR(0.5 * (layers.force * layers.displacement), energy, 1e-10 * energy);
    });
  }

  template <int dim>
  void expect_matrix_forms_agree()
  {
    for_all_layers<dim>([](const Mesh<dim> &mesh, const ElasticSolid<dim> &solid, const bool is_held) {
      Layers<dim> layers(mesh, solid, is_held);
      layers.displace(1);
      const auto             matrix = test::dense_matrix(*layers.bonds);
      dealii::Vector<double> u(matrix.m()), f(matrix.m());
      const auto             range = layers.displacement.locally_owned_elements();
      for (const auto k : range)
        u[k] = layers.displacement[k];
      dealii::Utilities::MPI::sum(u, MPI_COMM_WORLD, u);
      matrix.vmult(f, u);
      for (const auto k : range)
        EXPECT_NEAR(layers.force[k], f[k], 1e-12 * f.linfty_norm());
      const auto blocks = layers.bonds->jacobi_blocks();
      const auto first  = range.is_empty() ? 0 : *range.begin();
      for (LocalIndex i = 0; i < blocks.size(); ++i)
        {
          dealii::Tensor<2, dim> of_diagonal;
          for (int a = 0; a < dim; ++a)
            for (int b = 0; b < dim; ++b)
              of_diagonal[a][b] = matrix(first + dim * i + a, first + dim * i + b);
          test::expect_preconditions(blocks[i], of_diagonal);
        }
    });
  }

  template <int dim>
  void expect_spectrum()
  {
    for_all_layers<dim>([](const Mesh<dim> &mesh, const ElasticSolid<dim> &solid, const bool is_held) {
      if (is_held)
        return;
      Layers<dim>            layers(mesh, solid, false);
      const auto             values  = test::spectrum(*layers.bonds);
      const double           largest = values[values.size() - 1];
      constexpr unsigned int n_rigid = dim * (dim + 1) / 2;
      EXPECT_GE(values[0], -1e-12 * largest);
      EXPECT_LE(values[n_rigid - 1], 1e-12 * largest);
      EXPECT_GE(values[n_rigid], 1e-6 * largest);
    });
  }

  template <int dim>
  void expect_rank_independence()
  {
    const auto shared = make_all_layers<dim>(), alone = make_all_layers<dim>(MPI_COMM_SELF);
    for (std::size_t m = 0; m < shared.size(); ++m)
      {
        Layers<dim> divided(*shared[m], solids<dim>()[1], true), whole(*alone[m], solids<dim>()[1], true);
        divided.displace(2);
        whole.displace(2);
        for (LocalIndex i = 0; i < divided.body.nodes.size(); ++i)
          for (LocalIndex j = 0; j < whole.body.nodes.size(); ++j)
            if (divided.body.nodes.position[i].distance(whole.body.nodes.position[j]) < 1e-12)
              for (int d = 0; d < dim; ++d)
                {
                  EXPECT_NEAR(divided.force.local_element(dim * i + d),
                              whole.force.local_element(dim * j + d),
                              1e-12 * whole.force.linfty_norm());
                }
      }
  }

  /// Three cells across, or one: nothing to close, or nothing that could be.
  template <int dim>
  void expect_others_to_be_left_alone()
  {
    const auto closed_cells = [](const std::vector<unsigned int> &cells) {
      const auto mesh = make_layers<dim>(cells, 0.2);
      return Layers<dim>(*mesh, solids<dim>()[0], false).moments->cell_polynomials().closure().cells().size();
    };
    EXPECT_EQ(closed_cells(dim == 2 ? std::vector<unsigned int>{6, 3} : std::vector<unsigned int>{5, 4, 3}),
              0u);
    EXPECT_EQ(closed_cells(dim == 2 ? std::vector<unsigned int>{6, 1} : std::vector<unsigned int>{5, 4, 1}),
              0u);
  }
} // namespace

TEST(TwoLayers, BendExactly2D)
{
  expect_exact_bending<2>();
}
TEST(TwoLayers, BendExactly3D)
{
  expect_exact_bending<3>();
}
TEST(TwoLayers, MatrixDiagonalAndProductAgree2D)
{
  expect_matrix_forms_agree<2>();
}
TEST(TwoLayers, MatrixDiagonalAndProductAgree3D)
{
  expect_matrix_forms_agree<3>();
}
TEST(TwoLayers, Spectrum2D)
{
  expect_spectrum<2>();
}
TEST(TwoLayers, Spectrum3D)
{
  expect_spectrum<3>();
}
TEST(TwoLayers, SameOnAnyNumberOfRanks2D)
{
  expect_rank_independence<2>();
}
TEST(TwoLayers, SameOnAnyNumberOfRanks3D)
{
  expect_rank_independence<3>();
}
TEST(TwoLayers, OthersAreLeftAlone2D)
{
  expect_others_to_be_left_alone<2>();
}
TEST(TwoLayers, OthersAreLeftAlone3D)
{
  expect_others_to_be_left_alone<3>();
}
