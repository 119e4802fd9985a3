// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/models.h>
#include <perideal/operators/assembled_matrix.h>
#include <perideal/operators/missing_bonds.h>

#include "bodies.h"
#include "testing.h"

#include <cmath>

using namespace perideal;

namespace
{
  /// A box under the tractions of a uniform stress, with the bonds of a model.
  template <int dim>
  struct LoadedBox
  {
    LoadedBox(const Mesh<dim>                       &mesh,
              const std::string                     &model,
              const dealii::SymmetricTensor<2, dim> &strain,
              const std::vector<unsigned int>       &held = {})
      : body(mesh)
      , strain(strain)
    {
      ModelParameters parameters;
      parameters.model = model;
      parameters.form  = "energy";
      if (parameters.is_tensor_involved())
        parameters.form = "moment corrected";
      parameters.resolve(dim);
      const auto constants = parameters.constants_of_model(
        {70e9, 0.3, dim == 2 ? PlaneAssumption::plane_stress : PlaneAssumption::solid});
      const auto solid_of = [=](const dealii::types::material_id) { return ElasticSolid<dim>(constants); };
      stress              = ElasticSolid<dim>(constants).stiffness() * strain;

      // Boundaries are numbered lower x, upper x, lower y, ...; free faces are those without a condition.
      LoadParameters text;
      const char    *axes[] = {"x", "y", "z"};
      for (unsigned int f = 0; f < 2 * dim; ++f)
        {
          BoundaryConditionText condition;
          condition.name     = "face " + std::to_string(f);
          condition.boundary = std::to_string(f);
          for (unsigned int d = 0; d < dim; ++d)
            {
              if (std::count(held.begin(), held.end(), f) > 0)
                condition.displacement[d] = formula(dealii::Tensor<2, dim>(strain)[d], axes);
              else
                condition.traction[d] = std::to_string((f % 2 == 0 ? -1. : 1.) * stress[f / 2][d]);
            }
          text.conditions.push_back(condition);
        }
      loads                 = Loads<dim>(text);
      const auto boundaries = resolve_boundaries(mesh, loads);
      const auto planes     = find_surface_planes<dim>(
        body.nodes, gather_faces(find_boundary_faces(mesh, body.nodes), MPI_COMM_WORLD));
      plain   = create_bond_operator<dim>(body.families, *create_model<dim>(parameters, 1.), solid_of);
      missing = std::make_shared<MissingBonds<dim>>(
        plain,
        std::make_shared<const FaceGradient<dim>>(mesh, body.nodes, [](const auto) { return 1.; }),
        planes,
        loads,
        boundaries,
        solid_of);
    }

    static std::string formula(const dealii::Tensor<1, dim> &row, const char *const *axes)
    {
      std::string result = "0";
      for (int d = 0; d < dim; ++d)
        result += "+(" + std::to_string(row[d]) + ")*" + axes[d];
      return result;
    }

    /// Largest force on a node without balance under the uniform strain.
    double residual(const BondOperator<dim> &bonds, const bool with_tractions) const
    {
      NodalVector displacement, force, external;
      bonds.initialize(displacement);
      bonds.initialize(force);
      bonds.initialize(external);
      for (LocalIndex i = 0; i < body.nodes.size(); ++i)
        {
          const dealii::Tensor<1, dim> u = strain * body.nodes.position[i];
          for (int d = 0; d < dim; ++d)
            displacement.local_element(dim * i + d) = u[d];
        }
      bonds.vmult(force, displacement);
      if (with_tractions)
        missing->add_tractions(loads, 1., external);
      force -= external;
      return force.linfty_norm();
    }

    test::Body<dim>                    body;
    dealii::SymmetricTensor<2, dim>    strain, stress;
    Loads<dim>                         loads;
    std::shared_ptr<BondOperator<dim>> plain;
    std::shared_ptr<MissingBonds<dim>> missing;
  };

  /// Stretch, shear and both: any direction of traction.
  template <int dim>
  std::vector<dealii::SymmetricTensor<2, dim>> strains()
  {
    dealii::SymmetricTensor<2, dim> pull, shear;
    pull[0][0]             = 1e-3;
    pull[dim - 1][dim - 1] = -3e-4;
    shear[0][dim - 1]      = 5e-4;
    return {pull, shear, pull + 0.4 * shear};
  }

  template <int dim>
  void expect_uniform_stress(const Mesh<dim> &mesh)
  {
    for (const char *model : {"bond based", "ordinary", "extended ordinary", "tensor involved"})
      for (const auto &strain : strains<dim>())
        for (const std::vector<unsigned int> &held :
             {std::vector<unsigned int>(), std::vector<unsigned int>{0, 3}})
          {
            const LoadedBox<dim> box(mesh, model, strain, held);
            const double         before = box.residual(*box.plain, false);
            EXPECT_LT(box.residual(*box.missing, true), 1e-11 * before) << model;
          }
  }
} // namespace

TEST(MissingBonds, UniformStressIsExactOnPlates)
{
  expect_uniform_stress<2>(*test::make_box<2>({7, 6}, {1., 0.9}, 0.));
  expect_uniform_stress<2>(*test::make_box<2>({8, 7}, {1., 1.}, 0.3));
}

TEST(MissingBonds, UniformStressIsExactInSolids)
{
  expect_uniform_stress<3>(*test::make_box<3>({5, 5, 4}, {1., 1., 0.8}, 0.25));
}

TEST(MissingBonds, AreMissingNearSurfacesOfRegularMeshesOnly)
{
  const auto         mesh = test::make_box<2>({12, 10}, {1.2, 1.}, 0.);
  const LoadedBox<2> box(*mesh, "bond based", strains<2>()[0]);
  // Inside are 6 x 4 cells, three from any side.
  EXPECT_EQ(dealii::Utilities::MPI::sum(box.missing->n_incomplete(), MPI_COMM_WORLD), 120u - 24u);
}

TEST(MissingBonds, TractionsPullAsHardAsTheBondsWould)
{
  // The forces by tractions of one face sum up to the areal force of the lattice, which for sigma = 1 tends
  // to the area as the horizon holds more cells; here 3.01 spacings, 2-D, one point.
  const auto                    mesh = test::make_box<2>({12, 40}, {1.2, 4.}, 0.);
  dealii::SymmetricTensor<2, 2> strain;
  strain[0][0] = 1e-3;
  strain[1][1] = -1e-3 / 3;
  const LoadedBox<2> box(*mesh, "bond based", strain);
  NodalVector        force;
  box.missing->initialize(force);
  box.missing->add_tractions(box.loads, 1., force);
  double sum = 0;
  for (LocalIndex i = 0; i < box.body.nodes.size(); ++i)
    if (box.body.nodes.position[i][0] > 0.6)
      sum += force.local_element(2 * i);
  sum = dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  EXPECT_NEAR(sum / (box.stress[0][0] * 4.), 1., 0.1);
  EXPECT_LT(std::abs(box.stress[1][1]), 1e-9 * box.stress[0][0]);
}

TEST(MissingBonds, AssembleWhatTheyMultiply)
{
  const auto                             mesh = test::make_box<2>({7, 6}, {1., 0.9}, 0.3);
  const LoadedBox<2>                     box(*mesh, "bond based", strains<2>()[2]);
  const ConstrainedOperator<2>           system(box.missing,
                                      std::make_shared<MirrorLayer<2>>(box.body.nodes),
                                      box.body.nodes,
                                      std::vector<std::uint8_t>(2 * box.body.nodes.size(), 0));
  dealii::TrilinosWrappers::SparseMatrix matrix;
  assemble_matrix(system, matrix);
  NodalVector source, product, force;
  for (NodalVector *vector : {&source, &product, &force})
    system.initialize(*vector);
  for (LocalIndex i = 0; i < box.body.nodes.size(); ++i)
    for (int d = 0; d < 2; ++d)
      source.local_element(2 * i + d) = test::scatter(box.body.nodes.position[i], d);
  matrix.vmult(product, source);
  system.vmult(force, source);
  const double scale  = product.linfty_norm();
  const auto   blocks = box.missing->diagonal_blocks();
  const auto   first  = product.get_partitioner()->local_range().first;
  for (LocalIndex i = 0; i < blocks.size(); ++i)
    for (int a = 0; a < 2; ++a)
      {
        EXPECT_NEAR(product.local_element(2 * i + a), force.local_element(2 * i + a), 1e-12 * scale);
        for (int b = 0; b < 2; ++b)
          EXPECT_NEAR(blocks[i][a][b], matrix.el(first + 2 * i + a, first + 2 * i + b), 1e-12 * scale);
      }
}
