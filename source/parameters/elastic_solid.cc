// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/elastic_solid.h>

#include <array>

namespace perideal
{
  namespace
  {
    using dealii::SymmetricTensor;

    template <int dim>
    SymmetricTensor<4, dim> isotropic_stiffness(const double lambda, const double mu)
    {
      return lambda *
               outer_product(dealii::unit_symmetric_tensor<dim>(), dealii::unit_symmetric_tensor<dim>()) +
             2. * mu * dealii::identity_tensor<dim>();
    }

    /// Plane stress: the strains across the plane, (33, 23, 13), follow from vanishing stresses there and
    /// are put into the stresses in the plane.
    SymmetricTensor<4, 2> without_stress_across(const SymmetricTensor<4, 3> &solid)
    {
      const std::array<std::array<unsigned int, 2>, 3> across = {{{{2, 2}}, {{1, 2}}, {{0, 2}}}};
      dealii::Tensor<2, 3>                             coupling;
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          // Off-diagonal strains count twice.
          coupling[a][b] = (b == 0 ? 1. : 2.) * solid[across[a][0]][across[a][1]][across[b][0]][across[b][1]];
      const dealii::Tensor<2, 3> inverse = dealii::invert(coupling);

      SymmetricTensor<4, 2> result;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = i; j < 2; ++j)
          for (unsigned int k = 0; k < 2; ++k)
            for (unsigned int l = k; l < 2; ++l)
              {
                double value = solid[i][j][k][l];
                for (unsigned int a = 0; a < 3; ++a)
                  for (unsigned int b = 0; b < 3; ++b)
                    value -= (a == 0 ? 1. : 2.) * solid[i][j][across[a][0]][across[a][1]] * inverse[a][b] *
                             solid[across[b][0]][across[b][1]][k][l];
                result[i][j][k][l] = value;
              }
      return result;
    }

    SymmetricTensor<4, 2> in_plane(const SymmetricTensor<4, 3> &solid)
    {
      SymmetricTensor<4, 2> result;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = i; j < 2; ++j)
          for (unsigned int k = 0; k < 2; ++k)
            for (unsigned int l = k; l < 2; ++l)
              result[i][j][k][l] = solid[i][j][k][l];
      return result;
    }

    /// Traces of C: C_aabb and C_abab.
    template <int dim>
    std::array<double, 2> traces(const SymmetricTensor<4, dim> &c)
    {
      std::array<double, 2> result = {};
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          {
            result[0] += c[a][a][b][b];
            result[1] += c[a][b][a][b];
          }
      return result;
    }
  } // namespace

  template <int dim>
  ElasticSolid<dim>::ElasticSolid(const ElasticConstants &constants)
    : constants(constants)
    , tensor(isotropic_stiffness<dim>(constants.lame_lambda(), constants.shear_modulus()))
  {
    const ElasticConstants in_space = {
      constants.young_modulus, constants.poisson_ratio, PlaneAssumption::solid};
    solid = isotropic_stiffness<3>(in_space.lame_lambda(), in_space.shear_modulus());
  }

  template <int dim>
  ElasticSolid<dim>::ElasticSolid(const SymmetricTensor<4, 3> &in_space, const PlaneAssumption assumption)
    : solid(in_space)
  {
    if constexpr (dim == 3)
      tensor = in_space;
    else
      tensor =
        assumption == PlaneAssumption::plane_stress ? without_stress_across(in_space) : in_plane(in_space);
    // kappa = C_aabb/dim^2 and 2 mu = (C_abab - C_aabb/dim)/(dim(dim+1)/2 - 1).
    const auto   trace = traces(tensor);
    const double kappa = trace[0] / (dim * dim);
    const double mu    = (trace[1] - trace[0] / dim) / (dim * (dim + 1) - 2);
    constants = ElasticConstants::of_moduli(kappa, mu, dim == 3 ? PlaneAssumption::solid : assumption);
    has_no_direction =
      (tensor - isotropic_stiffness<dim>(constants.lame_lambda(), constants.shear_modulus())).norm() <
      1e-12 * tensor.norm();
  }

  template class ElasticSolid<2>;
  template class ElasticSolid<3>;
} // namespace perideal
