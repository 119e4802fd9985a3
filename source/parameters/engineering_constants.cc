// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/elastic_solid.h>
#include <perideal/parameters/engineering_constants.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>

namespace perideal
{
  namespace
  {
    using dealii::SymmetricTensor;
    using Numbers = std::vector<double>;

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
    ConstantNames names_in_space(const SymmetryName symmetry)
    {
      if (symmetry == SymmetryName::cubic)
        return {"E", "nu", "G"};
      if (symmetry == SymmetryName::transversely_isotropic)
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
          throw symmetry.complaint("all moduli must be positive", parameter, numbers).allowed("numbers > 0");
      };
      positive("Young moduli", symmetry.young_moduli);
      positive("Shear moduli", symmetry.shear_moduli);

      const ConstantNames in_space = names_in_space(symmetry.name);
      if (in_space.all_fit(symmetry))
        return false;
      const bool may_be_plane =
        symmetry.name != SymmetryName::cubic && assumption == PlaneAssumption::plane_stress;
      if (may_be_plane && names_in_plane.all_fit(symmetry))
        return true;
      const auto        fits = in_space.fit(symmetry);
      const std::string in_plane =
        names_in_plane.young + "; " + names_in_plane.poisson + "; " + names_in_plane.shear;
      const auto misfit = [&](const char *parameter, const Numbers &given, const std::string &names) {
        return symmetry
          .complaint("the " + name_of(symmetry.name) + " symmetry needs other constants", parameter, given)
          .allowed(names)
          .hint(symmetry.name == SymmetryName::cubic ? "" : "plane stress alone can do with " + in_plane);
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
      if (symmetry.name == SymmetryName::cubic)
        return {{{e[0], e[0], e[0]}}, nu[0], nu[0], nu[0], {{1. / g[0], 1. / g[0], 1. / g[0]}}};
      if (symmetry.name == SymmetryName::transversely_isotropic)
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
  } // namespace

  dealii::SymmetricTensor<4, 3> engineering_stiffness(const ElasticSymmetry &symmetry,
                                                      const PlaneAssumption  assumption)
  {
    const bool in_plane    = check_constants(symmetry, assumption);
    const auto compliance  = compliance_of(constants_of(symmetry, in_plane));
    const auto eigenvalues = kelvin_eigenvalues(compliance);
    // Singular to round-off counts as singular.
    if (!(eigenvalues.front() > 1e-12 * eigenvalues.back()))
      throw symmetry
        .complaint("no elastic solid has these constants: their compliance is not positive definite",
                   "Poisson ratios",
                   symmetry.poisson_ratios)
        .allowed("|nu_ij| < sqrt(E_i/E_j), and such that every stress stores energy");
    return dealii::invert(compliance);
  }
} // namespace perideal
