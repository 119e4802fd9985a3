// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_stress_criteria_h
#define perideal_fracture_stress_criteria_h

#include <perideal/parameters/material_parameters.h>

#include <deal.II/base/symmetric_tensor.h>

#include <string>

namespace perideal
{
  /**
   * How close a stress is to the one at which a brittle material fails. With the principal stresses in space
   * sigma_1 >= sigma_2 >= sigma_3, tension positive, so that in plane stress the 0 across the plane is one of
   * them:
   *
   *     maximum tensile stress (VNOSB eq. 17):  sigma_1 / f_t
   *     Mohr-Coulomb (VNOSB eq. 18):            sigma_1 / f_t - sigma_3 / f_c
   *
   * The second is tau = c cos(phi) - (sigma_1 + sigma_3)/2 sin(phi), tau = (sigma_1 - sigma_3)/2, with the
   * cohesion c = sqrt(f_t f_c)/2 and the angle of internal friction sin(phi) = (f_c - f_t)/(f_c + f_t) that
   * make both uniaxial strengths come out. The plus sign printed in (18) is that of compression counted
   * positive: with tension positive it would make a pull stronger than a push.
   */
  class StressCriterion
  {
  public:
    /// Nothing fails.
    StressCriterion() = default;

    /// @param criterion not none
    /// @param tensile_strength f_t > 0 [Pa]
    /// @param compressive_strength f_c >= f_t [Pa], of Mohr-Coulomb only
    StressCriterion(const FailureCriterion criterion,
                    const double           tensile_strength,
                    const double           compressive_strength);

    /// Whether any stress reaches it.
    bool can_fail() const { return per_tension > 0; }

    /// Fails from 1 on [-]; proportional to the stress, and not positive where all principal stresses are
    /// pressures that the criterion does not count.
    /// @param stress Cauchy's, in space [Pa]
    double utilisation(const dealii::SymmetricTensor<2, 3> &stress) const;

  private:
    /// What sigma_1 and -sigma_3 count [1/Pa].
    double per_tension = 0., per_compression = 0.;
  };

  /// The criterion of one material of a scene; nothing fails without a criterion or a tensile strength.
  StressCriterion stress_criterion(const MaterialParameters &parameters, const MaterialProperties &material);
} // namespace perideal

#endif
