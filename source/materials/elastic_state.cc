// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/elastic_state.h>

#include <algorithm>
#include <cmath>

namespace perideal
{
  double ElasticState::von_mises() const
  {
    return std::sqrt(1.5) * dealii::deviator(stress).norm();
  }

  double ElasticState::triaxiality() const
  {
    const double shear = von_mises(), mean = trace(stress) / 3.;
    return shear > 1e-14 * std::abs(mean) ? mean / shear : 0.;
  }

  std::pair<double, double> ElasticState::principal_range() const
  {
    // Jacobi's method, because the closed formulas lose half the digits where two values are equal.
    const auto pairs = dealii::eigenvectors(stress, dealii::SymmetricTensorEigenvectorMethod::jacobi);
    return {pairs.front().first, pairs.back().first};
  }

  template <int dim>
  ElasticState elastic_state(const dealii::SymmetricTensor<2, dim> &strain,
                             const ElasticSolid<dim>               &solid,
                             const double                           expansion)
  {
    ElasticState state;
    if (expansion != 0.)
      {
        const auto elastic   = solid.strain_in_space(strain) - expansion * solid.expansion_in_space();
        state.stress         = solid.stiffness_in_space() * elastic;
        state.energy_density = 0.5 * (state.stress * elastic);
        state.strain         = solid.assumption() == PlaneAssumption::plane_strain ?
                                 solid.strain_in_space(strain) :
                                 elastic + expansion * dealii::unit_symmetric_tensor<3>();
        return state;
      }
    state.strain = solid.strain_in_space(strain);
    if (solid.assumption() != PlaneAssumption::plane_stress)
      state.stress = solid.stiffness_in_space() * state.strain;
    // The same in the plane, and the only ones in plane stress.
    const dealii::SymmetricTensor<2, dim> in_plane = solid.stiffness() * strain;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        state.stress[i][j] = in_plane[i][j];
    state.energy_density = 0.5 * (state.stress * state.strain);
    return state;
  }

  PERIDEAL_INSTANTIATE(elastic_state)
} // namespace perideal
