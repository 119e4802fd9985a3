// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/bulk_strength.h>
#include <perideal/materials/family_energy.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace perideal
{
  template <int dim>
  BulkStrength<dim>::BulkStrength(const FamilyView<dim>                     &family,
                                  const FamilyCoefficients                  &coefficients,
                                  const FamilyShape                         &shape,
                                  const std::vector<dealii::Tensor<1, dim>> &normals,
                                  const double                               lateral)
    : family(family)
    , coefficients(coefficients)
    , shape(shape)
    , normals(normals)
    , lateral(lateral)
  {
  }

  template <int dim>
  double BulkStrength<dim>::largest_strain(const std::vector<double> &squares, const BondFailing &how) const
  {
    // Strains are looked at in equal steps of their logarithm, in units of the first stretch: before the
    // first bond softens, and to where all do that are not nearly across the pull; and behind none.
    constexpr unsigned int n_steps = 40;
    constexpr double       lowest = 0.95, highest = 20.;

    std::array<double, n_steps + 2> strains = {};
    for (unsigned int step = 0; step <= n_steps; ++step)
      strains[1 + step] =
        how.first * lowest * std::pow(highest / lowest, static_cast<double>(step) / n_steps);
    std::array<double, n_steps + 2> inverse = {}, left;
    for (unsigned int k = 1; k < strains.size(); ++k)
      inverse[k] = 1. / strains[k];
    const SofteningLaw::Growing growing{strains.data(), inverse.data(), n_steps + 2};
    double                      mean = 0;
    for (const auto &normal : normals)
      {
        // Four times the stress at a unit strain: the energies of both strains together, and apart.
        std::vector<FamilyEnergy<dim>> sum(strains.size(), {coefficients, shape}), difference(sum);
        for (LocalIndex j = 0; j < family.size; ++j)
          {
            dealii::Tensor<1, dim> bond;
            for (int d = 0; d < dim; ++d)
              bond[d] = family.bond[d][j];
            const dealii::Tensor<1, dim> along = (bond * normal) * normal, across = lateral * (bond - along);
            // Along a bond, over the strain.
            const double stretch = (along - across) * bond / family.length_square[j],
                         square  = how.energy * squares[j];
            if (how.law.is_stable(how.first, square))
              how.law.look_along(growing, stretch, how.first, square, left.data());
            else
              for (unsigned int step = 0; step < strains.size(); ++step)
                left[step] = how.share(strains[step] * stretch, how.first, square);
            const auto of_sum        = sum[0].part_of(j, (2. * along - across) * bond, 2. * along - across),
                       of_difference = difference[0].part_of(j, across * bond, across);
            for (unsigned int step = 0; step < strains.size(); ++step)
              {
                sum[step].add(of_sum, left[step]);
                difference[step].add(of_difference, left[step]);
              }
          }
        const auto stress = [&](const unsigned int step) {
          return sum[step].twice() - difference[step].twice();
        };
        double largest = 0;
        for (unsigned int step = 1; step < strains.size(); ++step)
          largest = std::max(largest, strains[step] * stress(step));
        mean += largest / (stress(0) * normals.size());
      }
    return mean;
  }

  template <int dim>
  double BulkStrength<dim>::first_stretch(const double               strain,
                                          const std::vector<double> &squares,
                                          BondFailing                how) const
  {
    // The largest strain goes nearly with the first stretch.
    constexpr unsigned int most_steps = 10;
    for (unsigned int step = 0; step < most_steps; ++step)
      {
        const double largest = largest_strain(squares, how);
        if (!(largest > 0))
          return strain;
        if (std::abs(largest - strain) <= 1e-3 * strain)
          break;
        how.first = std::min(strain, how.first * strain / largest);
      }
    return how.first;
  }

  PERIDEAL_INSTANTIATE_CLASS(BulkStrength)
} // namespace perideal
