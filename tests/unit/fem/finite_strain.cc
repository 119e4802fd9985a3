// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem_test.h"

#include <perideal/base/exceptions.h>
#include <perideal/fem/hyperelastic_fem.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/physics/elasticity/kinematics.h>

namespace perideal::test
{
  namespace
  {
    template <int dim>
    LawsByMaterial<dim> one_law(const std::string    &name,
                                const PlaneAssumption assumption = dim == 2 ? PlaneAssumption::plane_stress :
                                                                              PlaneAssumption::solid)
    {
      return {{0, create_law<dim>(name, ElasticSolid<dim>(elastic_constants(assumption)))}};
    }

    template <int dim>
    typename HyperelasticFem<dim>::Controls to(const double tolerance)
    {
      typename HyperelasticFem<dim>::Controls controls;
      controls.tolerance = tolerance;
      return controls;
    }

    /// A displacement gradient of stretch, shear and rotation.
    template <int dim>
    dealii::Tensor<2, dim> large_gradient()
    {
      dealii::Tensor<2, dim> H;
      for (unsigned int a = 0; a < dim; ++a)
        {
          H[a][a]             = 0.3 - 0.2 * a;
          H[a][(a + 1) % dim] = 0.25 - 0.3 * a;
        }
      return H;
    }

    /// The displacement t H x as expressions.
    template <int dim>
    Components expressions(const dealii::Tensor<2, dim> &H)
    {
      const char *const axes[] = {"x", "y", "z"};
      std::string       text[3];
      for (unsigned int a = 0; a < dim; ++a)
        {
          text[a] = "t*(0";
          for (unsigned int b = 0; b < dim; ++b)
            text[a] += "+(" + exact_text(H[a][b]) + ")*" + axes[b];
          text[a] += ")";
        }
      return {text[0], text[1], text[2]};
    }

    template <int dim>
    void expect_uniform_deformation(const HyperelasticFem<dim>   &fem,
                                    const HyperelasticLaw<dim>   &law,
                                    const dealii::Tensor<2, dim> &H)
    {
      const auto points = some_points<dim>();
      const auto values = fem.evaluate(points);
      for (unsigned int k = 0; k < points.size(); ++k)
        EXPECT_LT((values[k] - H * points[k]).norm(), 1e-9);
      EXPECT_NEAR(fem.strain_energy(), law.energy(H), 1e-9 * young_modulus);
    }

    // Every law has the uniform deformation for an equilibrium, whatever the mesh: solved to 1e-11.
    template <int dim>
    void patch_test(const std::string &name)
    {
      SCOPED_TRACE(name);
      Mesh<dim> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, dim == 2 ? 4 : 3);
      distort(mesh);
      refine_locally(mesh, 1);
      ASSERT_TRUE(mesh.triangulation.has_hanging_nodes());
      const auto H    = large_gradient<dim>();
      const auto laws = one_law<dim>(name);
      const auto P    = laws.at(0)->stress(H);

      // All sides held.
      std::vector<BoundaryConditionText> conditions;
      for (unsigned int side = 0; side < 2 * dim; ++side)
        conditions.push_back(displacement(side_names[side], expressions(H)));
      const Loads<dim>     held = make_loads<dim>(conditions);
      HyperelasticFem<dim> all_held(mesh, held, laws, to<dim>(1e-11));
      all_held.solve_step(1.);
      expect_uniform_deformation(all_held, *laws.at(0), H);

      // The left side held, dead tractions P N on the others.
      conditions.resize(1);
      for (unsigned int side = 1; side < 2 * dim; ++side)
        {
          const auto component = [&](const unsigned int d) {
            return exact_text((side % 2 == 1 ? 1. : -1.) * P[d][side / 2]);
          };
          conditions.push_back(
            traction(side_names[side], {component(0), component(1), dim == 3 ? component(dim - 1) : ""}));
        }
      for (auto &condition : conditions)
        for (auto &text : condition.traction)
          if (!text.empty())
            text = "t*(" + text + ")";
      const Loads<dim>     pulled = make_loads<dim>(conditions);
      HyperelasticFem<dim> fem(mesh, pulled, laws, to<dim>(1e-11));
      for (const double time : {0.25, 0.5, 0.75, 1.})
        fem.solve_step(time);
      expect_uniform_deformation(fem, *laws.at(0), H);
      // The support bears what the other sides are pulled with.
      const auto reaction = fem.reaction(0);
      for (unsigned int d = 0; d < dim; ++d)
        EXPECT_NEAR(reaction[d], -P[d][0], 1e-9 * young_modulus);
    }

    TEST(HyperelasticFem, uniform_deformations_are_exact)
    {
      for (const std::string &name : LawChoice::list().names())
        {
          patch_test<2>(name);
          patch_test<3>(name);
        }
    }

    template <int dim>
    void derivatives(const std::string &name)
    {
      Mesh<dim> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 1);
      const dealii::MappingQ<dim> mapping(1);
      const dealii::FESystem<dim> element(dealii::FE_Q<dim>(1), dim);
      dealii::DoFHandler<dim>     unknowns(mesh.triangulation);
      unknowns.distribute_dofs(element);
      FiniteStrainIntegrals<dim> integrals(mapping, element, 0.7);
      const auto                 law = one_law<dim>(name).at(0);
      const unsigned int         n   = element.n_dofs_per_cell();
      for (const auto &cell : unknowns.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            dealii::Vector<double> values(n), more(n), less(n);
            for (unsigned int k = 0; k < n; ++k)
              values(k) = 0.15 * std::sin(7. * k + 1.);
            dealii::FullMatrix<double> tangent(n, n);
            integrals.reinit(cell, values);
            integrals.tangent(*law, tangent);
            const double step = 1e-5;
            for (unsigned int k = 0; k < n; ++k)
              {
                dealii::Vector<double> moved = values;
                double                 energy[2];
                for (const int side : {0, 1})
                  {
                    auto &forces = side == 0 ? less : more;
                    moved(k)     = values(k) + (side == 0 ? -step : step);
                    forces       = 0.;
                    integrals.reinit(cell, moved);
                    integrals.subtract_forces(*law, forces);
                    energy[side] = integrals.energy(*law);
                  }
                integrals.reinit(cell, values);
                dealii::Vector<double> forces(n);
                integrals.subtract_forces(*law, forces);
                // Central differences, to the square of the step.
                EXPECT_NEAR(-forces(k), (energy[1] - energy[0]) / (2 * step), 1e-8 * young_modulus);
                for (unsigned int l = 0; l < n; ++l)
                  EXPECT_NEAR(tangent(l, k), (less(l) - more(l)) / (2 * step), 1e-8 * young_modulus);
              }
          }
    }

    TEST(FiniteStrainIntegrals, forces_and_tangent_are_derivatives)
    {
      for (const std::string &name : LawChoice::list().names())
        {
          SCOPED_TRACE(name);
          derivatives<2>(name);
          derivatives<3>(name);
        }
    }

    TEST(HyperelasticFem, is_the_linear_one_under_the_linear_law)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 5);
      distort(mesh);
      LoadParameters parameters;
      parameters.conditions = {displacement("left", {"0", "0", ""}),
                               traction("right", {"1e8*t", "2e7*y*t", ""})};
      parameters.body_force = {{"0", "3e7*x*t", ""}};
      parameters.point_loads.push_back({"load", "0.63, 1", {{"0", "-1e7*t", ""}}});
      const Loads<2> loads(parameters);
      ElasticFem<2>  linear(mesh, loads);
      linear.assemble({{0, elastic_constants(PlaneAssumption::plane_stress)}}, 0.7);
      linear.solve(1e-12);
      HyperelasticFem<2> fem(mesh, loads, one_law<2>("linear elastic"), to<2>(1e-10));
      const auto         step = fem.solve_step(0.7);
      // Linear solves to 1e-3, then to a tenth of the tolerance.
      EXPECT_LE(step.iterations, 5u);
      EXPECT_LT(
        relative_error(linear, [&](const dealii::Point<2> &point) { return fem.evaluate({point})[0]; }),
        1e-8);
      EXPECT_LT((fem.reaction(0) - linear.reaction(0)).norm(), 1e-8 * linear.reaction(0).norm());
    }

    TEST(HyperelasticFem, a_rotated_body_has_no_stress)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 4);
      const Components   turned = {"(cos(t)-1)*x-sin(t)*y", "sin(t)*x+(cos(t)-1)*y", ""};
      const Loads<2>     loads = make_loads<2>({displacement("left", turned), displacement("right", turned)});
      HyperelasticFem<2> fem(mesh, loads, one_law<2>("Saint Venant-Kirchhoff"), to<2>(1e-8));
      for (const double time : {0.3, 0.6, 0.9})
        fem.solve_step(time);
      EXPECT_LT(fem.strain_energy(), 1e-9 * young_modulus);
      const auto points = some_points<2>();
      const auto values = fem.evaluate(points);
      for (unsigned int k = 0; k < points.size(); ++k)
        {
          const double x = points[k][0], y = points[k][1], c = std::cos(0.9) - 1, s = std::sin(0.9);
          EXPECT_NEAR(values[k][0], c * x - s * y, 1e-5);
          EXPECT_NEAR(values[k][1], s * x + c * y, 1e-5);
        }
    }

    TEST(HyperelasticFem, halves_a_step_that_folds_the_body)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 4);
      const Components   turned = {"(cos(t)-1)*x-sin(t)*y", "sin(t)*x+(cos(t)-1)*y", ""};
      const Loads<2>     loads = make_loads<2>({displacement("left", turned), displacement("right", turned)});
      HyperelasticFem<2> fem(mesh, loads, one_law<2>("neo-Hookean"), to<2>(1e-8));
      // Half a turn at once mirrors the body, linearly.
      EXPECT_GE(fem.solve_step(3.).halvings, 1u);
      EXPECT_LT(fem.strain_energy(), 1e-9 * young_modulus);
    }

    TEST(HyperelasticFem, says_where_it_stopped)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, 3);
      // Pressed through itself, which the law does not admit.
      const Loads<2> loads =
        make_loads<2>({displacement("left", {"0", "0", ""}), displacement("right", {"-1.5*t", "0", ""})});
      auto controls     = to<2>(1e-8);
      controls.halvings = 0;
      HyperelasticFem<2> fem(mesh, loads, one_law<2>("neo-Hookean"), controls);
      fem.solve_step(0.2);
      try
        {
          fem.solve_step(1.);
          FAIL() << "no error";
        }
      catch (const ComputationError &error)
        {
          EXPECT_NE(std::string(error.what()).find("t = 1"), std::string::npos) << error.what();
        }
    }

    /// A bar of 1 x 0.2 m whose ends are held across, pulled along.
    class StretchedBar : public ::testing::Test
    {
    protected:
      StretchedBar()
        : mesh(MPI_COMM_WORLD)
        , loads(make_loads<2>({displacement("left", {"0", "0", ""}), displacement("right", {"t", "0", ""})}))
        , fem(mesh_of_bar(),
              loads,
              {{0,
                create_law<2>("Saint Venant-Kirchhoff",
                              ElasticSolid<2>(ElasticConstants{70e9, 0.33, PlaneAssumption::plane_stress}))}},
              to<2>(1e-8))
      {
      }

      const Mesh<2> &mesh_of_bar()
      {
        dealii::GridGenerator::subdivided_hyper_rectangle(
          mesh.triangulation, {50, 12}, dealii::Point<2>(), dealii::Point<2>(1., 0.2), true);
        for (const auto &cell : mesh.triangulation.active_cell_iterators())
          cell->set_material_id(0);
        for (dealii::types::boundary_id side = 0; side < 4; ++side)
          {
            mesh.boundary_names[side_names[side]] = side;
            mesh.boundary_ids.insert(side);
          }
        mesh.material_ids.insert(0);
        return mesh;
      }

      double stretch_in_the_middle()
      {
        const auto u = fem.evaluate({{0.5, 0.1}, {0.52, 0.1}});
        return 1. + (u[1][0] - u[0][0]) / 0.02;
      }

      /// Of the whole width.
      double stretch_across()
      {
        const auto u = fem.evaluate({{0.5, 0.}, {0.5, 0.2}});
        return 1. + (u[1][1] - u[0][1]) / 0.2;
      }

      Mesh<2>            mesh;
      const Loads<2>     loads;
      HyperelasticFem<2> fem;
    };

    // The figures are those of an independent program on the same mesh, forces and the stretch across given
    // to five and four digits. Stretches vary over the middle by a thousandth, and across, at the end, by
    // half.
    TEST_F(StretchedBar, has_the_figures_of_another_program)
    {
      for (unsigned int k = 1; k <= 10; ++k)
        {
          fem.solve_step(0.1 * k);
          if (k == 5)
            {
              EXPECT_NEAR(stretch_in_the_middle(), 1.5048, 1e-3);
              EXPECT_NEAR(stretch_across(), 0.7633, 1e-4);
              EXPECT_NEAR(fem.reaction(1)[0] / 0.2, 6.6607e10, 1e-5 * 6.6607e10);
            }
        }
      EXPECT_NEAR(stretch_in_the_middle(), 2.0113, 2e-3);
      EXPECT_NEAR(fem.reaction(1)[0] / 0.2, 2.1661e11, 1e-4 * 2.1661e11);
    }
  } // namespace
} // namespace perideal::test
