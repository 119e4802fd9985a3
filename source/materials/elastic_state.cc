// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/materials/elastic_state.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  double ElasticState::von_mises() const
  {
    return std::sqrt(1.5) * dealii::deviator(stress).norm();
  }

  std::pair<double, double> ElasticState::principal_range() const
  {
    // Jacobi's method, because the closed formulas lose half the digits where two values are equal.
    const auto pairs = dealii::eigenvectors(stress, dealii::SymmetricTensorEigenvectorMethod::jacobi);
    return {pairs.front().first, pairs.back().first};
  }

  template <int dim>
  ElasticState elastic_state(const dealii::SymmetricTensor<2, dim> &strain, const ElasticConstants &constants)
  {
    const double lambda = constants.lame_lambda(), nu = constants.poisson_ratio;
    ElasticState state;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          state.strain[i][j] = strain[i][j];
          state.stress[i][j] =
            2. * constants.shear_modulus() * strain[i][j] + (i == j ? lambda * trace(strain) : 0.);
        }
    if (constants.assumption == PlaneAssumption::plane_stress)
      state.strain[2][2] = -nu / (1. - nu) * trace(strain);
    if (constants.assumption == PlaneAssumption::plane_strain)
      state.stress[2][2] = lambda * trace(strain);
    return state;
  }

  template ElasticState elastic_state(const dealii::SymmetricTensor<2, 2> &, const ElasticConstants &);
  template ElasticState elastic_state(const dealii::SymmetricTensor<2, 3> &, const ElasticConstants &);
} // namespace perideal
