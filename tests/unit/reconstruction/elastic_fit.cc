// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/reconstruction/elastic_fit.h>

#include "bodies.h"
#include "solids.h"

#include <Eigen/QR>

#include <gtest/gtest.h>

using namespace perideal;

namespace
{
  /// A cubic displacement, sum of coefficients (component by component) times monomials.
  template <int dim>
  class Cubic
  {
  public:
    Cubic()
    {
      for (int degree = 0; degree <= 3; ++degree)
        for (int a = 0; a <= degree; ++a)
          for (int b = 0; b <= (dim == 2 ? 0 : a); ++b)
            powers.push_back({{degree - a, a - b, b}});
      coefficients.resize(dim * powers.size());
      for (std::size_t k = 0; k < coefficients.size(); ++k)
        coefficients[k] = 1e-3 * std::sin(1. + 3.7 * k);
    }

    std::size_t size() const { return coefficients.size(); }

    /// A partial derivative of a component.
    double derivative(const int component, std::array<int, 3> order, const dealii::Point<dim> &x) const
    {
      double result = 0;
      for (std::size_t m = 0; m < powers.size(); ++m)
        result += coefficients[component * powers.size() + m] * derivative_of_monomial(m, order, x);
      return result;
    }

    dealii::Tensor<1, dim> displacement(const dealii::Point<dim> &x) const
    {
      dealii::Tensor<1, dim> result;
      for (int c = 0; c < dim; ++c)
        result[c] = derivative(c, {{0, 0, 0}}, x);
      return result;
    }

    dealii::Tensor<2, dim> gradient(const dealii::Point<dim> &x) const
    {
      dealii::Tensor<2, dim> result;
      for (int c = 0; c < dim; ++c)
        for (int d = 0; d < dim; ++d)
          result[c][d] = derivative(c, along(d), x);
      return result;
    }

    /// Div (C : grad u) [N/m^3].
    dealii::Tensor<1, dim> divergence(const ElasticSolid<dim> &solid, const dealii::Point<dim> &x) const
    {
      dealii::Tensor<1, dim> result;
      for (int i = 0; i < dim; ++i)
        for (int p = 0; p < dim; ++p)
          for (int k = 0; k < dim; ++k)
            for (int q = 0; q < dim; ++q)
              result[i] += solid.stiffness()[i][p][k][q] * derivative(k, along(p, q), x);
      return result;
    }

    /// Changes the coefficients as little as it takes to make the divergence of the stress zero everywhere.
    void bring_into_equilibrium(const ElasticSolid<dim> &solid)
    {
      // It is linear in space: zero at the corners of a simplex, it is zero.
      Eigen::MatrixXd       condition(dim * (dim + 1), size());
      const auto            mine = coefficients;
      const double          unit = solid.stiffness().norm();
      const Eigen::VectorXd now  = Eigen::Map<const Eigen::VectorXd>(mine.data(), size());
      for (std::size_t k = 0; k < size(); ++k)
        {
          std::fill(coefficients.begin(), coefficients.end(), 0.);
          coefficients[k] = 1.;
          for (int corner = 0; corner <= dim; ++corner)
            {
              dealii::Point<dim> x;
              if (corner > 0)
                x[corner - 1] = 1.;
              const auto force = divergence(solid, x);
              for (int c = 0; c < dim; ++c)
                condition(dim * corner + c, k) = force[c] / unit;
            }
        }
      const Eigen::VectorXd excess = condition.completeOrthogonalDecomposition().solve(condition * now);
      for (std::size_t k = 0; k < size(); ++k)
        coefficients[k] = now[k] - excess[k];
    }

  private:
    static std::array<int, 3> along(const int d)
    {
      std::array<int, 3> result{};
      ++result[d];
      return result;
    }
    static std::array<int, 3> along(const int d, const int e)
    {
      auto result = along(d);
      ++result[e];
      return result;
    }

    double derivative_of_monomial(const std::size_t         m,
                                  const std::array<int, 3> &order,
                                  const dealii::Point<dim> &x) const
    {
      double result = 1.;
      for (int d = 0; d < dim; ++d)
        {
          int power = powers[m][d];
          for (int k = 0; k < order[d]; ++k)
            result *= power--;
          result *= power > 0 ? std::pow(x[d], power) : 1.;
        }
      return result;
    }

    std::vector<std::array<int, 3>> powers;
    std::vector<double>             coefficients;
  };

  /// Displacements, equilibrium and tractions around a point, more than a cubic has coefficients.
  template <int dim>
  void expect_fit(const ElasticSolid<dim> &solid)
  {
    Cubic<dim> field;
    field.bring_into_equilibrium(solid);
    dealii::Point<dim> centre;
    for (int d = 0; d < dim; ++d)
      centre[d] = 0.1 * (d + 1);
    // With this weight the wish for small coefficients, of weight 1e-2, bends the field by some 1e-12.
    const double scale = 0.5, weight = 1e4;
    EXPECT_LE(field.divergence(solid, centre).norm(), 1e-15 * solid.stiffness().norm());

    ElasticFit<dim> fit(centre, scale, field.displacement(centre), solid);
    for (unsigned int k = 0; k < 60; ++k)
      {
        dealii::Point<dim> x = centre;
        for (int d = 0; d < dim; ++d)
          x[d] += 1.5 * scale * test::scatter(dealii::Point<dim>(centre * (k + 1.)), d);
        if (k < 20)
          for (int c = 0; c < dim; ++c)
            fit.add_displacement(x, c, field.displacement(x)[c], weight);
        else if (k < 40)
          fit.add_equilibrium(x, dealii::Tensor<1, dim>(), weight);
        else
          {
            dealii::Tensor<1, dim> normal = x - centre;
            normal /= normal.norm();
            const dealii::SymmetricTensor<2, dim> stress = solid.stiffness() * symmetrize(field.gradient(x));
            for (int c = 0; c < dim; ++c)
              fit.add_traction(x, normal, c, (stress * normal)[c], weight);
          }
      }
    const auto result = fit.solve();
    EXPECT_LE((result.displacement - field.displacement(centre)).norm(),
              1e-11 * field.displacement(centre).norm());
    EXPECT_LE((result.gradient - field.gradient(centre)).norm(), 1e-11 * field.gradient(centre).norm());
  }
} // namespace

TEST(ElasticFit, IsExactForCubicFieldsInEquilibrium)
{
  expect_fit<2>(ElasticConstants{70e9, 0.3, PlaneAssumption::plane_stress});
  expect_fit<3>(ElasticConstants{70e9, 0.3, PlaneAssumption::solid});
}
TEST(ElasticFit, IsExactForAnisotropicSolids)
{
  expect_fit(test::solid_without_symmetry<2>());
  expect_fit(test::solid_without_symmetry<3>());
}
