// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/parameters/elastic_solid.h>

#include <deal.II/physics/notation.h>

#include <Eigen/Eigenvalues>

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

    SymmetricTensor<2, 3> embed(const SymmetricTensor<2, 2> &in_plane)
    {
      SymmetricTensor<2, 3> result;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = i; j < 2; ++j)
          result[i][j] = in_plane[i][j];
      return result;
    }

    /// Plane stress: the strains across the plane, (33, 23, 13), follow from vanishing stresses there.
    SymmetricTensor<2, 3> without_stress_across(const SymmetricTensor<4, 3> &solid,
                                                const SymmetricTensor<2, 2> &in_plane)
    {
      constexpr unsigned int      across[3][2] = {{2, 2}, {1, 2}, {0, 2}};
      auto                        result       = embed(in_plane);
      const SymmetricTensor<2, 3> held         = solid * result;
      dealii::Tensor<2, 3>        coupling;
      dealii::Tensor<1, 3>        stress;
      for (unsigned int a = 0; a < 3; ++a)
        {
          stress[a] = held[across[a][0]][across[a][1]];
          for (unsigned int b = 0; b < 3; ++b)
            // Off-diagonal strains count twice.
            coupling[a][b] =
              (b == 0 ? 1. : 2.) * solid[across[a][0]][across[a][1]][across[b][0]][across[b][1]];
        }
      const dealii::Tensor<1, 3> strain = dealii::invert(coupling) * stress;
      for (unsigned int a = 0; a < 3; ++a)
        result[across[a][0]][across[a][1]] = -strain[a];
      return result;
    }

    SymmetricTensor<2, 3> in_space(const SymmetricTensor<4, 3> &solid,
                                   const PlaneAssumption        assumption,
                                   const SymmetricTensor<2, 2> &strain)
    {
      return assumption == PlaneAssumption::plane_stress ? without_stress_across(solid, strain) :
                                                           embed(strain);
    }

    /// What the plane assumption leaves: the stresses in the plane under each strain in it.
    SymmetricTensor<4, 2> reduce(const SymmetricTensor<4, 3> &solid, const PlaneAssumption assumption)
    {
      SymmetricTensor<4, 2> result;
      for (unsigned int k = 0; k < 2; ++k)
        for (unsigned int l = k; l < 2; ++l)
          {
            SymmetricTensor<2, 2> strain;
            strain[k][l]                       = k == l ? 1. : 0.5;
            const SymmetricTensor<2, 3> stress = solid * in_space(solid, assumption, strain);
            for (unsigned int i = 0; i < 2; ++i)
              for (unsigned int j = i; j < 2; ++j)
                result[i][j][k][l] = stress[i][j];
          }
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
      tensor = reduce(in_space, assumption);
    // kappa = C_aabb/dim^2 and 2 mu = (C_abab - C_aabb/dim)/(dim(dim+1)/2 - 1).
    const auto   trace = traces(tensor);
    const double kappa = trace[0] / (dim * dim);
    const double mu    = (trace[1] - trace[0] / dim) / (dim * (dim + 1) - 2);
    constants = ElasticConstants::of_moduli(kappa, mu, dim == 3 ? PlaneAssumption::solid : assumption);
    has_no_direction =
      (tensor - isotropic_stiffness<dim>(constants.lame_lambda(), constants.shear_modulus())).norm() <
      1e-12 * tensor.norm();
  }

  template <int dim>
  SymmetricTensor<2, 3> ElasticSolid<dim>::strain_in_space(const SymmetricTensor<2, dim> &strain) const
  {
    if constexpr (dim == 3)
      return strain;
    else
      return in_space(solid, constants.assumption, strain);
  }

  template <int dim>
  SymmetricTensor<2, 3> ElasticSolid<dim>::expansion_in_space() const
  {
    return constants.assumption == PlaneAssumption::plane_stress ?
             strain_in_space(dealii::unit_symmetric_tensor<dim>()) :
             dealii::unit_symmetric_tensor<3>();
  }

  template <int dim>
  SymmetricTensor<2, dim> ElasticSolid<dim>::stress_of_expansion() const
  {
    const SymmetricTensor<2, 3> in_space = solid * expansion_in_space();
    SymmetricTensor<2, dim>     result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        result[i][j] = in_space[i][j];
    return result;
  }

  template <int dim>
  ElasticSolid<dim> elastic_solid(const SymmetricTensor<4, dim> &stiffness)
  {
    if constexpr (dim == 3)
      return {stiffness, PlaneAssumption::solid};
    else
      {
        // What lies across the plane is of no effect in plane strain.
        SymmetricTensor<4, 3> in_space;
        for (int i = 0; i < 2; ++i)
          for (int j = i; j < 2; ++j)
            for (int k = 0; k < 2; ++k)
              for (int l = k; l < 2; ++l)
                in_space[i][j][k][l] = stiffness[i][j][k][l];
        in_space[2][2][2][2] = stiffness[0][0][0][0];
        in_space[0][2][0][2] = in_space[1][2][1][2] = stiffness[0][1][0][1];
        return {in_space, PlaneAssumption::plane_strain};
      }
  }

  template <int dim>
  std::vector<double> kelvin_eigenvalues(const SymmetricTensor<4, dim> &tensor)
  {
    const auto      kelvin = dealii::Physics::Notation::Kelvin::to_matrix(tensor);
    Eigen::MatrixXd matrix(kelvin.m(), kelvin.n());
    for (unsigned int a = 0; a < kelvin.m(); ++a)
      for (unsigned int b = 0; b < kelvin.n(); ++b)
        matrix(a, b) = kelvin(a, b);
    const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
    return {values.begin(), values.end()};
  }

  PERIDEAL_INSTANTIATE(kelvin_eigenvalues)
  PERIDEAL_INSTANTIATE(elastic_solid)
  PERIDEAL_INSTANTIATE_CLASS(ElasticSolid)
} // namespace perideal
