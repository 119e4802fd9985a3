// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/reconstruction/polynomial_closure.h>

#include <deal.II/base/memory_consumption.h>

#include <Eigen/LU>

#include <algorithm>

namespace perideal
{
  namespace
  {
    /// Second derivatives of the quadratic monomials.
    template <int dim>
    dealii::Tensor<2, dim> hessian(const unsigned int p)
    {
      const auto [a, b] = SymmetricPairs<dim>::axes(p);
      dealii::Tensor<2, dim> result;
      result[a][b] += 1.;
      result[b][a] += 1.;
      return result;
    }

    /// sum_kl M_kl d_k eps : C : d_l eps as a matrix on quadratic coefficients, component b of monomial p at
    /// dim p + b.
    template <int dim>
    Eigen::MatrixXd energy_of(const dealii::SymmetricTensor<2, dim> &second_moment,
                              const dealii::SymmetricTensor<4, dim> &stiffness)
    {
      constexpr unsigned int n = Monomials<dim>::n_quadratic;
      Eigen::MatrixXd        result(dim * n, dim * n);
      for (unsigned int p = 0; p < n; ++p)
        for (unsigned int q = 0; q < n; ++q)
          {
            const auto product = hessian<dim>(p) * dealii::Tensor<2, dim>(second_moment) * hessian<dim>(q);
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = 0; b < dim; ++b)
                {
                  double sum = 0;
                  for (unsigned int k = 0; k < dim; ++k)
                    for (unsigned int l = 0; l < dim; ++l)
                      sum += stiffness[a][k][b][l] * product[k][l];
                  result(dim * p + a, dim * q + b) = sum;
                }
          }
      return result;
    }

    /// Quadratic coefficients of displacements: column dim j + a is component a of polynomial j.
    template <int dim>
    Eigen::MatrixXd displacements(const std::vector<std::array<double, Monomials<dim>::n_terms>> &polynomials)
    {
      constexpr unsigned int n      = Monomials<dim>::n_quadratic;
      Eigen::MatrixXd        result = Eigen::MatrixXd::Zero(dim * n, dim * polynomials.size());
      for (std::size_t j = 0; j < polynomials.size(); ++j)
        for (unsigned int p = 0; p < n; ++p)
          for (unsigned int a = 0; a < dim; ++a)
            result(dim * p + a, dim * j + a) = polynomials[j][dim + p];
      return result;
    }
  } // namespace

  template <int dim>
  void PolynomialClosure<dim>::add(const LocalIndex                       cell,
                                   const std::vector<Terms>              &undetermined,
                                   const std::vector<Terms>              &across,
                                   const dealii::SymmetricTensor<2, dim> &second_moment,
                                   const dealii::SymmetricTensor<4, dim> &stiffness)
  {
    const Eigen::MatrixXd condition =
      displacements<dim>(across).transpose() * energy_of(second_moment, stiffness);
    const Eigen::MatrixXd answer =
      -(condition * displacements<dim>(undetermined)).partialPivLu().solve(condition);
    for (std::size_t j = 0; j < undetermined.size(); ++j)
      {
        Direction direction{};
        direction.polynomial = undetermined[j];
        for (unsigned int q = 0; q < dim * n_quadratic; ++q)
          for (unsigned int a = 0; a < dim; ++a)
            direction.answer[q].value[a] = answer(dim * j + a, q);
        all.push_back(direction);
      }
    closed.push_back(cell);
    first.push_back(all.size());
  }

  template <int dim>
  dealii::ArrayView<const typename PolynomialClosure<dim>::Direction>
  PolynomialClosure<dim>::directions(const LocalIndex cell) const
  {
    const auto at = std::lower_bound(closed.begin(), closed.end(), cell);
    if (at == closed.end() || *at != cell)
      return {nullptr, 0};
    const std::size_t n = at - closed.begin();
    return {all.data() + first[n], first[n + 1] - first[n]};
  }

  template <int dim>
  void PolynomialClosure<dim>::close(const std::size_t n, Lanes *terms) const
  {
    // All by the fitted coefficients.
    Lanes amount[n_quadratic] = {};
    for (std::size_t j = first[n]; j < first[n + 1]; ++j)
      for (unsigned int p = 0; p < n_quadratic; ++p)
        for (unsigned int b = 0; b < dim; ++b)
          amount[j - first[n]] += terms[dim + p][b] * lanes(all[j].answer[dim * p + b]);
    for (std::size_t j = first[n]; j < first[n + 1]; ++j)
      for (unsigned int t = 0; t < n_terms; ++t)
        terms[t] += all[j].polynomial[t] * amount[j - first[n]];
  }

  template <int dim>
  void PolynomialClosure<dim>::add_transposed(const std::size_t n, Lanes *acting) const
  {
    Lanes on_amount[n_quadratic] = {};
    for (std::size_t j = first[n]; j < first[n + 1]; ++j)
      for (unsigned int t = 0; t < n_terms; ++t)
        on_amount[j - first[n]] += all[j].polynomial[t] * acting[t];
    for (std::size_t j = first[n]; j < first[n + 1]; ++j)
      for (unsigned int p = 0; p < n_quadratic; ++p)
        for (unsigned int b = 0; b < dim; ++b)
          acting[dim + p][b] += sum_of_all(on_amount[j - first[n]] * lanes(all[j].answer[dim * p + b]));
  }

  template <int dim>
  std::size_t PolynomialClosure<dim>::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(closed) + memory_consumption(first) + all.size() * sizeof(Direction);
  }

  PERIDEAL_INSTANTIATE_CLASS(PolynomialClosure)
} // namespace perideal
