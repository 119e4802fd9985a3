// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_law_tools_h
#define perideal_parameters_law_tools_h

#include <perideal/parameters/elastic_solid.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <memory>

/// What several laws of the continuum need.
namespace perideal
{
  template <int dim>
  class HyperelasticLaw;

  /// A symmetric tensor of the problem's own dimension in space, nothing across.
  template <int dim>
  dealii::SymmetricTensor<2, 3> in_space(const dealii::SymmetricTensor<2, dim> &tensor)
  {
    dealii::SymmetricTensor<2, 3> result;
    for (int i = 0; i < dim; ++i)
      for (int j = i; j < dim; ++j)
        result[i][j] = tensor[i][j];
    return result;
  }

  /// Lame's lambda [Pa] of the solid in space, whatever the plane assumption.
  inline double lame_lambda_in_space(const ElasticConstants &constants)
  {
    return ElasticConstants{constants.young_modulus, constants.poisson_ratio, PlaneAssumption::solid}
      .lame_lambda();
  }

  /// dP/dF of P = F S, delta_ik S_JL + F_iK C_KJML F_kM.
  /// @param S the second Piola-Kirchhoff stress [Pa]
  /// @param C dS/dE of it, with Green's strain E [Pa]
  template <int dim>
  dealii::Tensor<4, dim> tangent_of(const dealii::Tensor<2, dim>          &F,
                                    const dealii::SymmetricTensor<2, dim> &S,
                                    const dealii::Tensor<4, dim>          &C)
  {
    dealii::Tensor<4, dim> result;
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        for (int k = 0; k < dim; ++k)
          for (int L = 0; L < dim; ++L)
            {
              double sum = i == k ? S[J][L] : 0.;
              for (int K = 0; K < dim; ++K)
                for (int M = 0; M < dim; ++M)
                  sum += F[i][K] * C[K][J][M][L] * F[k][M];
              result[i][J][k][L] = sum;
            }
    return result;
  }

  /// A law of that class, for the list of laws.
  template <template <int> class Law, int dim>
  std::shared_ptr<const HyperelasticLaw<dim>> create_as(const ElasticSolid<dim> &solid)
  {
    return std::make_shared<Law<dim>>(solid);
  }
} // namespace perideal

#endif
