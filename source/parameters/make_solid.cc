// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/parameters/elastic_symmetry.h>
#include <perideal/parameters/engineering_constants.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>
#include <deal.II/physics/transformations.h>

#include <array>
#include <vector>

// From the constants of a material to its stiffness.

namespace perideal
{
  namespace
  {
    using dealii::SymmetricTensor;
    using Numbers = std::vector<double>;

    /// Indices of the stresses "11 22 ...", counted from 0.
    std::vector<std::array<unsigned int, 2>> index_pairs(const std::string &order)
    {
      std::vector<std::array<unsigned int, 2>> result;
      for (const std::string &pair : dealii::Utilities::split_string_list(order, ' '))
        result.push_back(
          {{static_cast<unsigned int>(pair[0] - '1'), static_cast<unsigned int>(pair[1] - '1')}});
      return result;
    }

    template <int dim>
    SymmetricTensor<4, 3> from_stiffness(const ElasticSymmetry &symmetry)
    {
      const Numbers &given    = symmetry.stiffness;
      const bool     in_plane = dim == 2 && given.size() == 6;
      if (!in_plane && given.size() != 21)
        throw symmetry
          .complaint("the anisotropic symmetry needs another number of constants", "Stiffness", given)
          .allowed(dim == 2 ? "21 numbers, or the 6 of the plane [Pa]" : "21 numbers [Pa]");
      const auto            pairs = index_pairs(in_plane ? "11 22 12" : symmetry.voigt_order);
      SymmetricTensor<4, 3> result;
      auto                  value = given.begin();
      for (std::size_t row = 0; row < pairs.size(); ++row)
        for (std::size_t column = row; column < pairs.size(); ++column, ++value)
          {
            const auto &ij = pairs[row], &kl = pairs[column];
            result[ij[0]][ij[1]][kl[0]][kl[1]] = result[kl[0]][kl[1]][ij[0]][ij[1]] = *value;
          }
      if (in_plane)
        {
          // Uncoupled across the plane, where any stiffness will do.
          const double across = result.norm();
          result[2][2][2][2] = result[1][2][1][2] = result[0][2][0][2] = across;
        }
      return result;
    }

    /// What ElasticSolid and those who use it divide by.
    /// @throws InputError when it is not positive.
    template <int dim>
    void check_stiffness(const ElasticSymmetry       &symmetry,
                         const SymmetricTensor<4, 3> &c,
                         const PlaneAssumption        assumption)
    {
      const auto complain = [&](const std::string &problem, const std::string &allowed) {
        throw symmetry.complaint(problem, "Stiffness", symmetry.stiffness).allowed(allowed);
      };
      if (assumption == PlaneAssumption::plane_stress)
        {
          SymmetricTensor<2, 3> across;
          const unsigned int    pairs[3][2] = {{2, 2}, {1, 2}, {0, 2}};
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = a; b < 3; ++b)
              across[a][b] = c[pairs[a][0]][pairs[a][1]][pairs[b][0]][pairs[b][1]];
          if (!(dealii::eigenvalues(across)[2] > 1e-12 * c.norm()))
            complain(
              "plane stress takes out the stresses across the plane, and nothing resists strains there",
              "C33, C44 (23) and C55 (13) of a positive definite block");
        }
      const ElasticConstants mean = ElasticSolid<dim>(c, assumption).isotropic();
      if (!(mean.shear_modulus() > 0 && mean.bulk_modulus() > 0))
        complain("the mean over all directions of this stiffness is not positive",
                 "a stiffness whose isotropic mean is one of an elastic solid");
    }
  } // namespace

  template <int dim>
  dealii::Tensor<2, 3> ElasticSymmetry::rotation() const
  {
    if (orientation.size() > 1 && (dim == 2 || orientation.size() != 3))
      throw complaint("this is no orientation", "Orientation", orientation)
        .allowed(dim == 2 ? "one angle about z [degrees]" :
                            "one angle about z, or three Euler angles (z, x, z) [degrees]");
    using dealii::Physics::Transformations::Rotations::rotation_matrix_3d;
    dealii::Tensor<2, 3> result = dealii::unit_symmetric_tensor<3>();
    for (std::size_t k = 0; k < orientation.size(); ++k)
      {
        dealii::Tensor<1, 3> axis;
        axis[k == 1 ? 0 : 2] = 1.;
        result               = result * rotation_matrix_3d(axis, orientation[k] * dealii::numbers::PI / 180.);
      }
    return result;
  }

  template <int dim>
  ElasticSolid<dim> make_solid(const ElasticSymmetry &symmetry, const PlaneAssumption assumption)
  {
    Assert(!symmetry.is_isotropic(), dealii::ExcMessage("an isotropic solid has no axes"));
    const auto in_own_axes = symmetry.name == SymmetryName::anisotropic ?
                               from_stiffness<dim>(symmetry) :
                               engineering_stiffness(symmetry, assumption);
    const auto turned =
      dealii::Physics::Transformations::basis_transformation(in_own_axes, symmetry.rotation<dim>());
    check_stiffness<dim>(symmetry, turned, assumption);
    return {turned, assumption};
  }

  template dealii::Tensor<2, 3> ElasticSymmetry::rotation<2>() const;
  template dealii::Tensor<2, 3> ElasticSymmetry::rotation<3>() const;
  PERIDEAL_INSTANTIATE(make_solid)
} // namespace perideal
