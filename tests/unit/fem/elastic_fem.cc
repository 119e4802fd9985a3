// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem_test.h"

#include <perideal/base/exceptions.h>

// Uniform or piecewise uniform states, which elements represent exactly: the
// tolerances are those of the linear solver (1e-13) and round-off.
namespace perideal::test
{
  namespace
  {
    constexpr double tolerance = 1e-10, pull = 1e8;

    /// Rests on the planes x = 0, y = 0 (z = 0), pulled along x.
    template <int dim>
    Loads<dim> uniaxial_tension()
    {
      std::vector<BoundaryConditionText> conditions = {displacement("left", {"0", "", ""}),
                                                       displacement("bottom", {"", "0", ""}),
                                                       traction("right", {"1e8", "", ""})};
      if (dim == 3)
        conditions.push_back(displacement("front", {"", "", "0"}));
      return make_loads<dim>(conditions);
    }

    /// Error of uniaxial tension, given the strains along and across.
    template <int dim>
    double uniaxial_error(const PlaneAssumption assumption, const double along, const double across)
    {
      Mesh<dim> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 4);
      const Loads<dim> loads = uniaxial_tension<dim>();
      ElasticFem<dim>  fem(mesh, loads);
      fem.assemble({{0, elastic_constants(assumption)}}, 0.);
      EXPECT_EQ(fem.n_pins(), 0u);
      fem.solve(1e-13);
      return relative_error(fem, [&](const dealii::Point<dim> &point) {
        dealii::Tensor<1, dim> exact = across * point;
        exact[0]                     = along * point[0];
        return exact;
      });
    }

    TEST(ElasticFem, plane_stress_and_plane_strain)
    {
      const double E = young_modulus, nu = poisson_ratio;
      EXPECT_LT(uniaxial_error<2>(PlaneAssumption::plane_stress, pull / E, -nu * pull / E), tolerance);
      EXPECT_LT(
        uniaxial_error<2>(PlaneAssumption::plane_strain, (1 - nu * nu) * pull / E, -nu * (1 + nu) * pull / E),
        tolerance);
      EXPECT_LT(uniaxial_error<3>(PlaneAssumption::solid, pull / E, -nu * pull / E), tolerance);
    }

    TEST(ElasticFem, materials_in_series)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 4);
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        cell->set_material_id(cell->center()[0] < 0.5 ? 3 : 7);
      const Loads<2> loads = uniaxial_tension<2>();
      ElasticFem<2>  fem(mesh, loads);
      // Without lateral contraction the halves do not disturb one another.
      const ElasticConstants soft = {100e9, 0., PlaneAssumption::plane_stress},
                             hard = {200e9, 0., PlaneAssumption::plane_stress};
      fem.assemble({{3, soft}, {7, hard}}, 0.);
      fem.solve(1e-13);
      const auto exact = [](const dealii::Point<2> &point) {
        dealii::Tensor<1, 2> value;
        value[0] = pull * (std::min(point[0], 0.5) / 100e9 + std::max(point[0] - 0.5, 0.) / 200e9);
        return value;
      };
      EXPECT_LT(relative_error(fem, exact), tolerance);
    }

    TEST(ElasticFem, a_material_without_constants_is_an_error)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 4);
      for (const auto &cell : mesh.triangulation.active_cell_iterators())
        cell->set_material_id(5);
      const Loads<2> loads = uniaxial_tension<2>();
      ElasticFem<2>  fem(mesh, loads);
      EXPECT_ANY_THROW(fem.assemble(one_material<2>(), 0.));
    }

    TEST(ElasticFem, prescribed_displacement_follows_time)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 3);
      const Loads<2> loads = make_loads<2>({displacement("left", {"0", "0", ""}),
                                            displacement("right", {"1e-3*t", "0", ""}),
                                            displacement("bottom", {"", "0", ""}),
                                            displacement("top", {"", "0", ""})});
      ElasticFem<2>  fem(mesh, loads);
      for (const double time : {0., 2., 0.5})
        {
          fem.assemble(one_material<2>(), time);
          fem.solve(1e-13);
          for (const auto &value : fem.evaluate({dealii::Point<2>(0.4, 0.7)}))
            EXPECT_NEAR(value[0], 0.4e-3 * time, 1e-13);
        }
    }

    TEST(ElasticFem, no_load_no_displacement)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 3);
      const Loads<2> loads = make_loads<2>({displacement("left", {"0", "0", ""})});
      ElasticFem<2>  fem(mesh, loads);
      fem.assemble(one_material<2>(), 0.);
      EXPECT_EQ(fem.solve(1e-10), 0u);
      EXPECT_EQ(fem.solution().linfty_norm(), 0.);
    }

    TEST(ElasticFem, unknown_boundary_is_an_input_error)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 2);
      const Loads<2> pulled = make_loads<2>({traction("lid", {"1", "", ""})});
      EXPECT_THROW(ElasticFem<2>(mesh, pulled), InputError);
      const Loads<2> held = make_loads<2>({displacement("lid", {"1", "", ""})});
      EXPECT_THROW(ElasticFem<2>(mesh, held), InputError);
    }

    template <int dim>
    void pinned_body_is_right_up_to_a_rigid_motion(const std::vector<BoundaryConditionText> &held,
                                                   const unsigned int                        expected_pins)
    {
      Mesh<dim> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 4);
      distort(mesh);
      std::vector<BoundaryConditionText> conditions = held;
      conditions.push_back(traction("left", {"-1e8", "", ""}));
      conditions.push_back(traction("right", {"1e8", "", ""}));
      const Loads<dim> loads = make_loads<dim>(conditions);
      ElasticFem<dim>  fem(mesh, loads);
      fem.assemble(
        {{0, elastic_constants(dim == 2 ? PlaneAssumption::plane_stress : PlaneAssumption::solid)}}, 0.);
      EXPECT_EQ(fem.n_pins(), expected_pins);
      fem.solve(1e-13);

      // A small rigid motion leaves all distances: (u_a - u_b).(x_a - x_b) knows the strain only.
      const auto points = some_points<dim>();
      const auto values = fem.evaluate(points);
      for (unsigned int a = 0; a < points.size(); ++a)
        for (unsigned int b = 0; b < a; ++b)
          {
            const dealii::Tensor<1, dim> arm   = points[a] - points[b];
            double                       exact = arm[0] * arm[0];
            for (unsigned int d = 1; d < dim; ++d)
              exact -= poisson_ratio * arm[d] * arm[d];
            EXPECT_NEAR(
              (values[a] - values[b]) * arm, pull / young_modulus * exact, tolerance * pull / young_modulus);
          }
    }

    TEST(ElasticFem, pins_replace_missing_supports)
    {
      pinned_body_is_right_up_to_a_rigid_motion<2>({}, 3);
      pinned_body_is_right_up_to_a_rigid_motion<3>({}, 6);
      pinned_body_is_right_up_to_a_rigid_motion<2>({displacement("bottom", {"", "0", ""})}, 1);
      pinned_body_is_right_up_to_a_rigid_motion<3>({displacement("bottom", {"", "0", ""})}, 3);
    }

    std::vector<dealii::Tensor<1, 2>> pinned_displacements(MPI_Comm communicator)
    {
      Mesh<2> mesh(communicator);
      make_unit_box(mesh, 6);
      distort(mesh);
      refine_locally(mesh, 1);
      const Loads<2> loads =
        make_loads<2>({traction("left", {"-1e8", "", ""}), traction("right", {"1e8", "", ""})});
      ElasticFem<2> fem(mesh, loads);
      fem.assemble(one_material<2>(), 0.);
      fem.solve(1e-13);
      return fem.evaluate(some_points<2>());
    }

    TEST(ElasticFem, pins_do_not_depend_on_the_number_of_ranks)
    {
      const auto alone = pinned_displacements(MPI_COMM_SELF), together = pinned_displacements(MPI_COMM_WORLD);
      for (unsigned int i = 0; i < alone.size(); ++i)
        EXPECT_LT((alone[i] - together[i]).norm(), tolerance * pull / young_modulus);
    }

    template <int dim>
    void reactions_balance_the_loads(const bool hanging_nodes)
    {
      Mesh<dim> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 3);
      if (hanging_nodes)
        refine_locally(mesh, 2);
      if (dim == 2)
        mesh.thickness = 0.02;
      LoadParameters parameters;
      parameters.conditions                 = {displacement("left", {"0", "0", dim == 3 ? "0" : ""}),
                                               traction("right", {"1e6*y", "-2e6", ""})};
      parameters.conditions.back().pressure = "3e6";
      parameters.body_force                 = {{"", "-7e5*x", ""}};
      const Loads<dim> loads(parameters);
      ElasticFem<dim>  fem(mesh, loads);
      fem.assemble(one_material<dim>(), 0.);
      fem.solve(1e-12);

      const auto   reaction = fem.reaction(0);
      const double depth    = dim == 2 ? 0.02 : 1.;
      EXPECT_NEAR(reaction[0], -depth * (0.5e6 - 3e6), depth * 1e-2);
      EXPECT_NEAR(reaction[1], -depth * (-2e6 - 3.5e5), depth * 1e-2);
      EXPECT_NEAR(fem.reaction(1).norm(), 0., depth * 1e-2);
    }

    TEST(ElasticFem, reactions_balance_the_loads)
    {
      for (const bool hanging_nodes : {false, true})
        {
          reactions_balance_the_loads<2>(hanging_nodes);
          reactions_balance_the_loads<3>(hanging_nodes);
        }
    }
  } // namespace
} // namespace perideal::test
