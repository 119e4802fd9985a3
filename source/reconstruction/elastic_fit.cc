// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/reconstruction/elastic_fit.h>

#include <algorithm>
#include <numeric>

namespace perideal
{
  namespace
  {
    /// d^d/dx^d x^power.
    double differentiate(const unsigned int power, const unsigned int derivative, const double x)
    {
      if (derivative > power)
        return 0.;
      double result = 1.;
      for (unsigned int k = 0; k < power; ++k)
        result *= k < derivative ? static_cast<double>(power - k) : x;
      return result;
    }

    /// Weight of the wish that coefficients of a degree be small: only what
    /// the equations leave open feels it.
    double penalty(const unsigned int degree)
    {
      constexpr double of_degree[] = {0., 0., 1e-6, 1e-2};
      return of_degree[degree];
    }
  } // namespace

  template <int dim>
  ElasticFit<dim>::ElasticFit(const dealii::Point<dim>     &centre,
                              const double                  scale,
                              const dealii::Tensor<1, dim> &offset,
                              const ElasticSolid<dim>      &solid)
    : centre(centre)
    , scale(scale)
    , offset(offset)
    , twice_mu(2. * solid.isotropic().shear_modulus())
    , stiffness(solid.stiffness() / twice_mu)
  {
  }

  template <int dim>
  auto ElasticFit<dim>::monomials() -> const std::array<Powers, n_monomials> &
  {
    static const auto list = [] {
      std::array<Powers, n_monomials> result;
      unsigned int                    n = 0;
      for (unsigned int degree = 0; degree <= 3; ++degree)
        for (unsigned int i = 0; i <= degree; ++i)
          for (unsigned int j = 0; j <= (dim == 2 ? 0 : i); ++j)
            {
              Powers powers;
              powers[0] = degree - i;
              powers[1] = i - j;
              if constexpr (dim == 3)
                powers[2] = j;
              result[n++] = powers;
            }
      AssertDimension(n, n_monomials);
      return result;
    }();
    return list;
  }

  template <int dim>
  void ElasticFit<dim>::add_term(Row                          &row,
                                 const unsigned int            component,
                                 const Powers                 &derivative,
                                 const dealii::Tensor<1, dim> &x,
                                 const double                  factor)
  {
    for (unsigned int m = 0; m < n_monomials; ++m)
      {
        double value = factor;
        for (unsigned int d = 0; d < dim; ++d)
          value *= differentiate(monomials()[m][d], derivative[d], x[d]);
        row[component * n_monomials + m] += value;
      }
  }

  template <int dim>
  void ElasticFit<dim>::add_equation(const Row &row, const double value, const double weight)
  {
    for (const double coefficient : row)
      matrix.push_back(weight * coefficient);
    right_hand_side.push_back(weight * value);
  }

  template <int dim>
  void ElasticFit<dim>::add_displacement(const dealii::Point<dim> &point,
                                         const unsigned int        component,
                                         const double              value,
                                         const double              weight)
  {
    Row row{};
    add_term(row, component, Powers{}, scaled(point), 1.);
    add_equation(row, value - offset[component], weight);
  }

  template <int dim>
  void ElasticFit<dim>::add_traction(const dealii::Point<dim>     &point,
                                     const dealii::Tensor<1, dim> &normal,
                                     const unsigned int            component,
                                     const double                  value,
                                     const double                  weight)
  {
    // t_c = C_cpkq u_k,q n_p
    Row        row{};
    const auto x = scaled(point);
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int q = 0; q < dim; ++q)
        {
          double factor = 0.;
          for (unsigned int p = 0; p < dim; ++p)
            factor += stiffness[component][p][k][q] * normal[p];
          Powers along{};
          along[q] = 1;
          if (factor != 0.)
            add_term(row, k, along, x, factor);
        }
    add_equation(row, value * scale / twice_mu, weight);
  }

  template <int dim>
  void ElasticFit<dim>::add_equilibrium(const dealii::Point<dim>     &point,
                                        const dealii::Tensor<1, dim> &body_force,
                                        const double                  weight)
  {
    const auto x = scaled(point);
    for (unsigned int c = 0; c < dim; ++c)
      {
        Row row{};
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int p = 0; p < dim; ++p)
            for (unsigned int q = 0; q < dim; ++q)
              {
                Powers second{};
                ++second[p];
                ++second[q];
                if (stiffness[c][p][k][q] != 0.)
                  add_term(row, k, second, x, stiffness[c][p][k][q]);
              }
        add_equation(row, -body_force[c] * scale * scale / twice_mu, weight);
      }
  }

  template <int dim>
  auto ElasticFit<dim>::solve() const -> Result
  {
    using Matrix                  = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const std::size_t n_equations = right_hand_side.size();
    Matrix            equations   = Matrix::Zero(n_equations + n_unknowns, n_unknowns);
    Eigen::VectorXd   values      = Eigen::VectorXd::Zero(n_equations + n_unknowns);
    std::copy(matrix.begin(), matrix.end(), equations.data());
    std::copy(right_hand_side.begin(), right_hand_side.end(), values.data());
    for (unsigned int k = 0; k < n_unknowns; ++k)
      {
        const Powers &powers          = monomials()[k % n_monomials];
        equations(n_equations + k, k) = penalty(std::accumulate(powers.begin(), powers.end(), 0u));
      }
    const Eigen::VectorXd coefficients = least_squares(equations, values);

    Result result;
    result.displacement = offset;
    for (unsigned int c = 0; c < dim; ++c)
      {
        result.displacement[c] += coefficients[c * n_monomials];
        for (unsigned int d = 0; d < dim; ++d)
          result.gradient[c][d] = coefficients[c * n_monomials + 1 + d] / scale;
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(ElasticFit)
} // namespace perideal
