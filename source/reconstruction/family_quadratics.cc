// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/reconstruction/family_quadratics.h>

namespace perideal
{
  namespace
  {
    /// Of the largest eigenvalue: terms that members do not determine. Of whole families the smallest is
    /// 0.01.
    constexpr double undetermined = 1e-6;
  } // namespace

  template <int dim>
  FamilyQuadratics<dim>::FamilyQuadratics(const Families<dim>           &families,
                                          const NodalVector             &field,
                                          const std::vector<LocalIndex> &nodes)
    : families(families)
    , field(field)
    , nodes(nodes)
    , place(families.n_owned(), nowhere)
    , moments(nodes.size())
  {
    for (LocalIndex k = 0; k < nodes.size(); ++k)
      {
        place[nodes[k]] = k;
        add(nodes[k], nodes[k]);
      }
  }

  template <int dim>
  void FamilyQuadratics<dim>::add_to(const LocalIndex fit, const LocalIndex i, const LocalIndex j)
  {
    Moments                                      &m = moments[fit];
    std::array<double, Monomials<dim>::n>         value;
    Eigen::Map<Eigen::Matrix<double, n_terms, 1>> terms(value.data());
    Monomials<dim>::evaluate((families.position[j] - families.position[i]) / families.horizon[i], value);
    const double volume = families.volume[j];
    m.of_terms += volume * terms * terms.transpose();
    // Steps from the node, which lose no digits to where it went.
    for (int d = 0; d < dim; ++d)
      m.of_values.col(d) +=
        volume * (field.local_element(dim * j + d) - field.local_element(dim * i + d)) * terms;
  }

  template <int dim>
  std::vector<dealii::Tensor<2, dim>> FamilyQuadratics<dim>::gradients() const
  {
    std::vector<dealii::Tensor<2, dim>> result(nodes.size());
    for (LocalIndex k = 0; k < nodes.size(); ++k)
      {
        const Eigen::MatrixXd polynomials =
          solve_by_pseudo_inverse(moments[k].of_terms, moments[k].of_values, undetermined);
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            result[k][a][b] = polynomials(1 + b, a) / families.horizon[nodes[k]];
      }
    return result;
  }

  PERIDEAL_INSTANTIATE_CLASS(FamilyQuadratics)
} // namespace perideal
