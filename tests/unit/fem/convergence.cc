// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem_test.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/vector_tools.h>

// Manufactured solution u = (S, 0), S = sin(pi x) sin(pi y), plane strain. With
// C = cos(pi x) cos(pi y) the body force -(lambda+mu) grad div u - mu laplace u is
//   pi^2 ((lambda + 3 mu) S, -(lambda + mu) C).
namespace perideal::test
{
  namespace
  {
    class Exact : public dealii::Function<2>
    {
    public:
      Exact()
        : dealii::Function<2>(2)
      {
      }
      double value(const dealii::Point<2> &p, const unsigned int component) const override
      {
        using dealii::numbers::PI;
        return component == 0 ? std::sin(PI * p[0]) * std::sin(PI * p[1]) : 0.;
      }
    };

    Loads<2> manufactured_loads()
    {
      const ElasticConstants constants = elastic_constants(PlaneAssumption::plane_strain);
      const double           lambda = constants.lame_lambda(), mu = constants.shear_modulus();
      LoadParameters         parameters;
      for (int side = 0; side < 4; ++side)
        parameters.conditions.push_back(displacement(side_names[side], {"0", "0", ""}));
      parameters.body_force = {{exact_text(lambda + 3 * mu) + "*pi^2*sin(pi*x)*sin(pi*y)",
                                exact_text(-(lambda + mu)) + "*pi^2*cos(pi*x)*cos(pi*y)",
                                ""}};
      return Loads<2>(parameters);
    }

    double l2_error(const unsigned int n, const unsigned int degree)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, n);
      distort(mesh);
      // The thickness must cancel.
      mesh.thickness       = 0.01;
      const Loads<2> loads = manufactured_loads();
      ElasticFem<2>  fem(mesh, loads, degree);
      fem.assemble(one_material<2>(), 0.);
      fem.solve(1e-11);

      const auto            &triangulation = fem.dof_handler().get_triangulation();
      dealii::Vector<double> of_cells(triangulation.n_active_cells());
      dealii::VectorTools::integrate_difference(fem.mapping(),
                                                fem.dof_handler(),
                                                fem.solution(),
                                                Exact(),
                                                of_cells,
                                                dealii::QGauss<2>(degree + 3),
                                                dealii::VectorTools::L2_norm);
      return dealii::VectorTools::compute_global_error(triangulation, of_cells, dealii::VectorTools::L2_norm);
    }

    double order(const unsigned int degree)
    {
      return std::log2(l2_error(16, degree) / l2_error(32, degree));
    }

    // The asymptotic orders are 2 and 3; these meshes reach them to a few hundredths.
    TEST(Convergence, linear_elements_are_of_second_order)
    {
      EXPECT_NEAR(order(1), 2., 0.1);
    }
    TEST(Convergence, quadratic_elements_are_of_third_order)
    {
      EXPECT_GT(order(2), 2.9);
    }

    TEST(Convergence, error_is_small)
    {
      EXPECT_LT(l2_error(32, 2), 2e-5);
    }
  } // namespace
} // namespace perideal::test
