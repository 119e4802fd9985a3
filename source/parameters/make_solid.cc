// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/exceptions.h>
#include <perideal/parameters/elastic_symmetry.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>
#include <deal.II/physics/transformations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

// From the constants of a material to its stiffness.

namespace perideal
{
  namespace
  {
    using dealii::SymmetricTensor;
    using Numbers = std::vector<double>;

    std::string text_of(const Numbers &numbers)
    {
      std::ostringstream text;
      for (const double number : numbers)
        text << (text.tellp() > 0 ? ", " : "") << number;
      return numbers.empty() ? "nothing" : text.str();
    }

    InputError complaint(const std::string     &problem,
                         const ElasticSymmetry &symmetry,
                         const std::string     &parameter,
                         const Numbers         &given)
    {
      return InputError(problem).parameter(symmetry.section + "/" + parameter).given(text_of(given));
    }

    /// Names of the constants that a symmetry takes, separated by commas.
    struct ConstantNames
    {
      std::string young, poisson, shear;

      /// Whether each list has its number of entries.
      std::array<bool, 3> fit(const ElasticSymmetry &symmetry) const
      {
        const auto count = [](const std::string &names) {
          return dealii::Utilities::split_string_list(names, ',').size();
        };
        return {{symmetry.young_moduli.size() == count(young),
                 symmetry.poisson_ratios.size() == count(poisson),
                 symmetry.shear_moduli.size() == count(shear)}};
      }
      bool all_fit(const ElasticSymmetry &symmetry) const
      {
        const auto each = fit(symmetry);
        return each[0] && each[1] && each[2];
      }
    };

    /// All constants of a symmetry in space.
    ConstantNames names_in_space(const std::string &symmetry)
    {
      if (symmetry == "cubic")
        return {"E", "nu", "G"};
      if (symmetry == "transversely isotropic")
        return {"E1, E2", "nu12, nu23", "G12"};
      return {"E1, E2, E3", "nu12, nu13, nu23", "G12, G13, G23"};
    }

    /// Those of the plane, where some may be left out.
    const ConstantNames names_in_plane = {"E1, E2", "nu12", "G12"};

    /// True when the constants are those of the plane alone.
    /// @throws InputError when neither set is complete, or values are not positive that must be.
    bool check_constants(const ElasticSymmetry &symmetry, const PlaneAssumption assumption)
    {
      const auto positive = [&](const std::string &parameter, const Numbers &numbers) {
        if (!std::all_of(numbers.begin(), numbers.end(), [](const double number) { return number > 0; }))
          throw complaint("all moduli must be positive", symmetry, parameter, numbers).allowed("numbers > 0");
      };
      positive("Young moduli", symmetry.young_moduli);
      positive("Shear moduli", symmetry.shear_moduli);

      const ConstantNames in_space = names_in_space(symmetry.name);
      if (in_space.all_fit(symmetry))
        return false;
      const bool is_plane = symmetry.name != "cubic" && names_in_plane.all_fit(symmetry);
      if (is_plane && assumption == PlaneAssumption::plane_stress)
        return true;
      const auto fits   = in_space.fit(symmetry);
      const auto misfit = [&](const char *parameter, const Numbers &given, const std::string &names) {
        return complaint(
                 "the " + symmetry.name + " symmetry needs other constants", symmetry, parameter, given)
          .allowed(names)
          .hint(is_plane ? "only plane stress can do without the constants across the plane" : "");
      };
      if (!fits[0])
        throw misfit("Young moduli", symmetry.young_moduli, in_space.young + " [Pa]");
      if (!fits[1])
        throw misfit("Poisson ratios", symmetry.poisson_ratios, in_space.poisson);
      throw misfit("Shear moduli", symmetry.shear_moduli, in_space.shear + " [Pa]");
    }

    /// Moduli and ratios of the three axes.
    struct EngineeringConstants
    {
      std::array<double, 3> young;
      double                nu12, nu13, nu23;
      /// 1/G12, 1/G13, 1/G23 [1/Pa].
      std::array<double, 3> shear_compliance;
    };

    EngineeringConstants constants_of(const ElasticSymmetry &symmetry, const bool in_plane)
    {
      const Numbers &e = symmetry.young_moduli, &nu = symmetry.poisson_ratios, &g = symmetry.shear_moduli;
      // Uncoupled across the plane; the stiffness there has no influence on what happens in it.
      if (in_plane)
        return {{{e[0], e[1], e[1]}}, nu[0], 0., 0., {{1. / g[0], 1. / g[0], 1. / g[0]}}};
      if (symmetry.name == "cubic")
        return {{{e[0], e[0], e[0]}}, nu[0], nu[0], nu[0], {{1. / g[0], 1. / g[0], 1. / g[0]}}};
      if (symmetry.name == "transversely isotropic")
        // Across the fibre it is isotropic.
        return {
          {{e[0], e[1], e[1]}}, nu[0], nu[0], nu[1], {{1. / g[0], 1. / g[0], 2. * (1. + nu[1]) / e[1]}}};
      return {{{e[0], e[1], e[2]}}, nu[0], nu[1], nu[2], {{1. / g[0], 1. / g[1], 1. / g[2]}}};
    }

    /// eps_ii = sum_j S_iijj sigma_jj with S_iijj = -nu_ij/E_i, 2 eps_ij = sigma_ij/G_ij.
    SymmetricTensor<4, 3> compliance_of(const EngineeringConstants &constants)
    {
      SymmetricTensor<4, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i][i][i][i] = 1. / constants.young[i];
      const auto couple =
        [&](const unsigned int i, const unsigned int j, const double nu, const double shear) {
          result[i][i][j][j] = result[j][j][i][i] = -nu / constants.young[i];
          result[i][j][i][j]                      = shear / 4.;
        };
      couple(0, 1, constants.nu12, constants.shear_compliance[0]);
      couple(0, 2, constants.nu13, constants.shear_compliance[1]);
      couple(1, 2, constants.nu23, constants.shear_compliance[2]);
      return result;
    }

    SymmetricTensor<4, 3> from_constants(const ElasticSymmetry &symmetry, const PlaneAssumption assumption)
    {
      const bool in_plane    = check_constants(symmetry, assumption);
      const auto compliance  = compliance_of(constants_of(symmetry, in_plane));
      const auto eigenvalues = kelvin_eigenvalues(compliance);
      // Singular to round-off counts as singular.
      if (!(eigenvalues.front() > 1e-12 * eigenvalues.back()))
        throw complaint("no elastic solid has these constants: their compliance is not positive definite",
                        symmetry,
                        "Poisson ratios",
                        symmetry.poisson_ratios)
          .allowed("|nu_ij| < sqrt(E_i/E_j), and such that every stress stores energy");
      return dealii::invert(compliance);
    }

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
        throw complaint(
          "the anisotropic symmetry needs another number of constants", symmetry, "Stiffness", given)
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

    /// From the material's axes to those of the body.
    template <int dim>
    dealii::Tensor<2, 3> rotation(const ElasticSymmetry &symmetry)
    {
      const Numbers &angles = symmetry.orientation;
      if (angles.size() > 1 && (dim == 2 || angles.size() != 3))
        throw complaint("this is no orientation", symmetry, "Orientation", angles)
          .allowed(dim == 2 ? "one angle about z [degrees]" :
                              "one angle about z, or three Euler angles (z, x, z) [degrees]");
      using dealii::Physics::Transformations::Rotations::rotation_matrix_3d;
      dealii::Tensor<2, 3> result = dealii::unit_symmetric_tensor<3>();
      for (std::size_t k = 0; k < angles.size(); ++k)
        {
          dealii::Tensor<1, 3> axis;
          axis[k == 1 ? 0 : 2] = 1.;
          result               = result * rotation_matrix_3d(axis, angles[k] * dealii::numbers::PI / 180.);
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
        throw complaint(problem, symmetry, "Stiffness", symmetry.stiffness).allowed(allowed);
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
  ElasticSolid<dim> make_solid(const ElasticSymmetry &symmetry, const PlaneAssumption assumption)
  {
    Assert(!symmetry.is_isotropic(), dealii::ExcMessage("an isotropic solid has no axes"));
    const auto in_own_axes =
      symmetry.name == "anisotropic" ? from_stiffness<dim>(symmetry) : from_constants(symmetry, assumption);
    const auto turned =
      dealii::Physics::Transformations::basis_transformation(in_own_axes, rotation<dim>(symmetry));
    check_stiffness<dim>(symmetry, turned, assumption);
    return {turned, assumption};
  }

  template ElasticSolid<2> make_solid(const ElasticSymmetry &, const PlaneAssumption);
  template ElasticSolid<3> make_solid(const ElasticSymmetry &, const PlaneAssumption);
} // namespace perideal
