// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/materials/bulk_strength.h>
#include <perideal/materials/family_energy.h>

#include <algorithm>
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
    // first bond softens, and to where all do that are not nearly across the pull.
    constexpr unsigned int n_steps = 40;
    constexpr double       lowest = 0.95, highest = 20.;

    double                              mean = 0;
    std::vector<dealii::Tensor<1, dim>> pull(family.size), bonds(family.size);
    for (LocalIndex j = 0; j < family.size; ++j)
      for (int d = 0; d < dim; ++d)
        bonds[j][d] = family.bond[d][j];
    for (const auto &normal : normals)
      {
        for (LocalIndex j = 0; j < family.size; ++j)
          pull[j] = (bonds[j] * normal) * normal;
        const auto eps_of = [&](const LocalIndex j) {
          return pull[j] * bonds[j] - lateral * (family.length_square[j] - pull[j] * bonds[j]);
        };
        // Four times the stress at a unit strain: the energies of both strains together, and apart.
        const auto stress = [&](const auto &share) {
          FamilyEnergy<dim> sum(coefficients, shape), difference(coefficients, shape);
          for (LocalIndex j = 0; j < family.size; ++j)
            {
              const double                 left   = share(j);
              const dealii::Tensor<1, dim> across = lateral * (bonds[j] - pull[j]);
              sum.add(j, left, (2. * pull[j] - across) * bonds[j], 2. * pull[j] - across);
              difference.add(j, left, across * bonds[j], across);
            }
          return sum.twice() - difference.twice();
        };
        double largest = 0;
        for (unsigned int step = 0; step <= n_steps; ++step)
          {
            const double strain =
              how.first * lowest * std::pow(highest / lowest, static_cast<double>(step) / n_steps);
            largest = std::max(largest, strain * stress([&](const LocalIndex j) {
                                          return how.share(strain * eps_of(j) / family.length_square[j],
                                                           how.first,
                                                           how.energy * squares[j]);
                                        }));
          }
        mean += largest / (stress([](const LocalIndex) { return 1.; }) * normals.size());
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
