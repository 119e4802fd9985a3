// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/operators/linear/polynomial_response.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace perideal
{
  namespace
  {
    template <int dim>
    using Pair = dealii::SymmetricTensor<2, dim>;

    /// Stiffnesses with one independent entry of 1.
    template <int dim>
    std::vector<dealii::SymmetricTensor<4, dim>> unit_stiffnesses()
    {
      std::vector<dealii::SymmetricTensor<4, dim>> result;
      constexpr unsigned int                       n = Pair<dim>::n_independent_components;
      for (unsigned int p = 0; p < n; ++p)
        for (unsigned int q = p; q < n; ++q)
          {
            const auto                      a = Pair<dim>::unrolled_to_component_indices(p);
            const auto                      b = Pair<dim>::unrolled_to_component_indices(q);
            dealii::SymmetricTensor<4, dim> unit;
            unit[a[0]][a[1]][b[0]][b[1]] = unit[b[0]][b[1]][a[0]][a[1]] = 1.;
            result.push_back(unit);
          }
      return result;
    }
  } // namespace

  template <int dim>
  PolynomialResponse<dim>::PolynomialResponse(const BondOperator<dim> &bonds, const Families<dim> &families)
    : bonds(bonds)
    , families(families)
  {
    const LocalIndex n = families.n_owned();
    // About the middle of the body, for the round-off's sake.
    for (int d = 0; d < dim; ++d)
      {
        double sum = 0;
        for (LocalIndex i = 0; i < n; ++i)
          sum += families.position[i][d];
        middle[d] = dealii::Utilities::MPI::sum(sum, families.communicator) /
                    dealii::Utilities::MPI::sum(static_cast<double>(n), families.communicator);
      }
    of_gradients.resize(n);
    of_curvature.resize(n);
    double largest = 0;
    for (int c = 0; c < dim; ++c)
      {
        const auto store = [&](auto &columns, const unsigned int column, const auto &monomial) {
          const auto forces = response([&](const dealii::Tensor<1, dim> &x) {
            dealii::Tensor<1, dim> u;
            u[c] = monomial(x);
            return u;
          });
          for (LocalIndex i = 0; i < n; ++i)
            columns[i].col(column) = forces.col(i);
        };
        for (int l = 0; l < dim; ++l)
          store(of_gradients, dim * c + l, [l](const auto &x) { return x[l]; });
        for (unsigned int p = 0; p < Basis::n_pairs; ++p)
          store(of_curvature, c * Basis::n_pairs + p, [p](const auto &x) {
            const auto pair = Pair<dim>::unrolled_to_component_indices(p);
            return (pair[0] == pair[1] ? 0.5 : 1.) * x[pair[0]] * x[pair[1]];
          });
      }
    for (LocalIndex i = 0; i < n; ++i)
      largest = std::max(largest, of_gradients[i].norm());
    // Far above rounding, far below one bond.
    tolerance = 1e-9 * dealii::Utilities::MPI::max(largest, families.communicator);
  }

  template <int dim>
  Eigen::Matrix<double, dim, Eigen::Dynamic> PolynomialResponse<dim>::response(
    const std::function<dealii::Tensor<1, dim>(const dealii::Tensor<1, dim> &)> &displacement) const
  {
    NodalVector u, force;
    bonds.initialize(u);
    bonds.initialize(force);
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      {
        const auto value = displacement(families.position[i] - middle);
        for (int d = 0; d < dim; ++d)
          u.local_element(dim * i + d) = value[d];
      }
    bonds.vmult(force, u);
    return Eigen::Map<const Eigen::Matrix<double, dim, Eigen::Dynamic>>(
      force.begin(), dim, families.n_owned());
  }

  template <int dim>
  typename PolynomialResponse<dim>::Map PolynomialResponse<dim>::force_of_gradient(const LocalIndex i) const
  {
    Map result = Map::Zero();
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int l = 0; l < dim; ++l)
        result.col(c * Basis::n_monomials + l) = under_gradient(i, c, l) / families.spacing[i];
    return result;
  }

  template <int dim>
  typename PolynomialResponse<dim>::Map PolynomialResponse<dim>::force(const LocalIndex i) const
  {
    const double                 spacing = families.spacing[i];
    const dealii::Tensor<1, dim> x       = families.position[i] - middle;
    Map                          result  = force_of_gradient(i);
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int p = 0; p < Basis::n_pairs; ++p)
        {
          // (X - x)_l (X - x)_m = X_l X_m - x_l X_m - x_m X_l + a constant.
          const auto                    pair  = Pair<dim>::unrolled_to_component_indices(p);
          Eigen::Matrix<double, dim, 1> about = of_curvature[i].col(c * Basis::n_pairs + p);
          about -= x[pair[0]] * under_gradient(i, c, pair[1]);
          if (pair[0] != pair[1])
            about -= x[pair[1]] * under_gradient(i, c, pair[0]);
          result.col(c * Basis::n_monomials + dim + p) = about / (spacing * spacing);
        }
    return result;
  }

  template <int dim>
  typename PolynomialResponse<dim>::Map PolynomialResponse<dim>::divergence(
    const dealii::SymmetricTensor<4, dim> &stiffness, const double volume, const double spacing)
  {
    Map          result = Map::Zero();
    const double factor = volume / (spacing * spacing);
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int p = 0; p < Basis::n_pairs; ++p)
        {
          const auto pair = Pair<dim>::unrolled_to_component_indices(p);
          const auto l = pair[0], m = pair[1];
          for (unsigned int k = 0; k < dim; ++k)
            result(k, c * Basis::n_monomials + dim + p) =
              factor * (l == m ? stiffness[k][l][c][l] : stiffness[k][l][c][m] + stiffness[k][m][c][l]);
        }
    return result;
  }

  template <int dim>
  std::optional<dealii::SymmetricTensor<4, dim>>
  PolynomialResponse<dim>::stiffness(const std::vector<std::uint8_t> &counts) const
  {
    constexpr std::size_t size = Map::SizeAtCompileTime;
    Eigen::VectorXd       sum  = Eigen::VectorXd::Zero(size + 1);
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (counts[i])
        {
          const Map whole = -force(i) * (families.spacing[i] * families.spacing[i]);
          sum.head(size) += Eigen::Map<const Eigen::VectorXd>(whole.data(), size);
          sum[size] += families.volume[i];
        }
    for (double &entry : sum)
      entry = dealii::Utilities::MPI::sum(entry, families.communicator);
    if (sum[size] == 0)
      return {};

    const auto      units = unit_stiffnesses<dim>();
    Eigen::MatrixXd of_units(size, units.size());
    for (std::size_t u = 0; u < units.size(); ++u)
      {
        const Map map   = divergence(units[u], 1., 1.);
        of_units.col(u) = Eigen::Map<const Eigen::VectorXd>(map.data(), size);
      }
    const Eigen::VectorXd           entries = least_squares(of_units, sum.head(size) / sum[size]);
    dealii::SymmetricTensor<4, dim> result;
    for (std::size_t u = 0; u < units.size(); ++u)
      result += entries[u] * units[u];
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(PolynomialResponse)
} // namespace perideal
