// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem_test.h"
#include "solids.h"

#include <deal.II/base/symmetric_tensor.h>

// Elements reproduce every linear displacement, on any mesh: what remains is the
// residual of CG (1e-13) times the condition of these small problems.
namespace perideal::test
{
  namespace
  {
    constexpr double tolerance = 1e-10;

    template <typename Dim>
    class PatchTest : public ::testing::Test
    {
    public:
      static constexpr int dim = Dim::value;

      static dealii::Tensor<1, dim> linear_displacement(const dealii::Point<dim> &point)
      {
        dealii::Tensor<1, dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = 1e-3 * ((d + 1.) * point[d] + 0.5 * point[(d + 1) % dim] + 0.2);
        return result;
      }

      /// The linear displacement as expressions.
      static Components expressions()
      {
        if (dim == 2)
          return {"1e-3*(x+0.5*y+0.2)", "1e-3*(2*y+0.5*x+0.2)", ""};
        return {"1e-3*(x+0.5*y+0.2)", "1e-3*(2*y+0.5*z+0.2)", "1e-3*(3*z+0.5*x+0.2)"};
      }

      static std::vector<BoundaryConditionText> all_sides_held()
      {
        std::vector<BoundaryConditionText> conditions;
        for (int side = 0; side < 2 * dim; ++side)
          conditions.push_back(displacement(side_names[side], expressions()));
        return conditions;
      }

      /// The left side is held, the others carry the tractions of the linear displacement.
      static std::vector<BoundaryConditionText>
      left_held_others_pulled(const ElasticSolid<dim> &solid = one_material<dim>().at(0))
      {
        dealii::SymmetricTensor<2, dim> strain;
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            strain[a][b] =
              1e-3 * ((a == b ? a + 1. : 0.) + 0.25 * ((a + 1) % dim == b) + 0.25 * ((b + 1) % dim == a));
        const dealii::SymmetricTensor<2, dim> stress = solid.stiffness() * strain;

        std::vector<BoundaryConditionText> conditions = {displacement("left", expressions())};
        for (int side = 1; side < 2 * dim; ++side)
          {
            const auto component = [&](const unsigned int d) {
              return exact_text((side % 2 == 1 ? 1. : -1.) * stress[d][side / 2]);
            };
            conditions.push_back(
              traction(side_names[side], {component(0), component(1), dim == 3 ? component(dim - 1) : ""}));
          }
        return conditions;
      }

      static double error(const Mesh<dim>                          &mesh,
                          const std::vector<BoundaryConditionText> &conditions,
                          const ElasticSolid<dim>                  &solid = one_material<dim>().at(0))
      {
        const Loads<dim> loads = make_loads<dim>(conditions);
        ElasticFem<dim>  fem(mesh, loads);
        fem.assemble({{0, solid}}, 0.);
        fem.solve(1e-13);
        return relative_error(fem, linear_displacement);
      }
    };

    using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
    TYPED_TEST_SUITE(PatchTest, Dimensions);

    TYPED_TEST(PatchTest, distorted_mesh_all_sides_held)
    {
      Mesh<TypeParam::value> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 5);
      distort(mesh);
      EXPECT_LT(this->error(mesh, this->all_sides_held()), tolerance);
    }

    TYPED_TEST(PatchTest, distorted_mesh_with_tractions)
    {
      Mesh<TypeParam::value> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 5);
      distort(mesh);
      EXPECT_LT(this->error(mesh, this->left_held_others_pulled()), tolerance);
    }

    TYPED_TEST(PatchTest, of_a_solid_without_symmetry)
    {
      Mesh<TypeParam::value> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 5);
      distort(mesh);
      const auto solid = solid_without_symmetry<TypeParam::value>();
      ASSERT_FALSE(solid.is_isotropic());
      // Measured: up to 8e-14.
      EXPECT_LT(this->error(mesh, this->left_held_others_pulled(solid), solid), 1e-12);
      EXPECT_LT(this->error(mesh, this->all_sides_held(), solid), 1e-12);
    }

    TYPED_TEST(PatchTest, hanging_nodes_with_tractions)
    {
      Mesh<TypeParam::value> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 4);
      distort(mesh);
      refine_locally(mesh, 2);
      ASSERT_TRUE(mesh.triangulation.has_hanging_nodes());
      EXPECT_LT(this->error(mesh, this->left_held_others_pulled()), tolerance);
      EXPECT_LT(this->error(mesh, this->all_sides_held()), tolerance);
    }
  } // namespace
} // namespace perideal::test
