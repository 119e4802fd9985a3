// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fem_test.h"
#include "solids.h"

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/vector_tools.h>

// Manufactured solution u = a S, S = sin(pi x) sin(pi y). With T = cos(pi x) cos(pi y) the body
// force -C_ipkq u_k,pq is
//   pi^2 a_k ((C_i1k1 + C_i2k2) S - (C_i1k2 + C_i2k1) T).
namespace perideal::test
{
  namespace
  {
    class Exact : public dealii::Function<2>
    {
    public:
      explicit Exact(const dealii::Tensor<1, 2> &amplitude)
        : dealii::Function<2>(2)
        , amplitude(amplitude)
      {
      }
      double value(const dealii::Point<2> &p, const unsigned int component) const override
      {
        using dealii::numbers::PI;
        return amplitude[component] * std::sin(PI * p[0]) * std::sin(PI * p[1]);
      }

    private:
      dealii::Tensor<1, 2> amplitude;
    };

    /// A solid and how far it moves along x and y.
    struct Problem
    {
      ElasticSolid<2>      solid;
      dealii::Tensor<1, 2> amplitude;
    };

    const Problem isotropic = {elastic_constants(PlaneAssumption::plane_strain),
                               dealii::Tensor<1, 2>({1., 0.})};

    Loads<2> manufactured_loads(const Problem &problem)
    {
      LoadParameters parameters;
      for (int side = 0; side < 4; ++side)
        parameters.conditions.push_back(displacement(side_names[side], {"0", "0", ""}));
      const auto &c = problem.solid.stiffness();
      for (unsigned int i = 0; i < 2; ++i)
        {
          double of_sines = 0., of_cosines = 0.;
          for (unsigned int k = 0; k < 2; ++k)
            {
              of_sines += problem.amplitude[k] * (c[i][0][k][0] + c[i][1][k][1]);
              of_cosines -= problem.amplitude[k] * (c[i][0][k][1] + c[i][1][k][0]);
            }
          parameters.body_force[i] = "pi^2*((" + exact_text(of_sines) + ")*sin(pi*x)*sin(pi*y)+(" +
                                     exact_text(of_cosines) + ")*cos(pi*x)*cos(pi*y))";
        }
      return Loads<2>(parameters);
    }

    double l2_error(const unsigned int n, const unsigned int degree, const Problem &problem = isotropic)
    {
      Mesh<2> mesh(MPI_COMM_WORLD);
      make_unit_box(mesh, n);
      distort(mesh);
      // The thickness must cancel.
      mesh.thickness       = 0.01;
      const Loads<2> loads = manufactured_loads(problem);
      ElasticFem<2>  fem(mesh, loads, degree);
      fem.assemble({{0, problem.solid}}, 0.);
      fem.solve(1e-11);

      const auto            &triangulation = fem.elements().unknowns.get_triangulation();
      dealii::Vector<double> of_cells(triangulation.n_active_cells());
      dealii::VectorTools::integrate_difference(fem.elements().geometry,
                                                fem.elements().unknowns,
                                                fem.solution(),
                                                Exact(problem.amplitude),
                                                of_cells,
                                                dealii::QGauss<2>(degree + 3),
                                                dealii::VectorTools::L2_norm);
      return dealii::VectorTools::compute_global_error(triangulation, of_cells, dealii::VectorTools::L2_norm);
    }

    double order(const unsigned int degree, const Problem &problem = isotropic)
    {
      return std::log2(l2_error(16, degree, problem) / l2_error(32, degree, problem));
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

    TEST(Convergence, of_a_solid_without_symmetry)
    {
      const Problem problem = {solid_without_symmetry<2>(), dealii::Tensor<1, 2>({1., -0.7})};
      ASSERT_FALSE(problem.solid.is_isotropic());
      EXPECT_NEAR(order(1, problem), 2., 0.1);
      EXPECT_GT(order(2, problem), 2.9);
      EXPECT_LT(l2_error(32, 2, problem), 2e-5);
    }

    TEST(Convergence, error_is_small)
    {
      EXPECT_LT(l2_error(32, 2), 2e-5);
    }
  } // namespace
} // namespace perideal::test
