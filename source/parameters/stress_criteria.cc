// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/material_parameters.h>
#include <perideal/parameters/stress_criteria.h>

#include <cmath>

namespace perideal
{
  namespace
  {
    using Stress = dealii::SymmetricTensor<2, 3>;

    // Principal stresses in space are sigma_1 >= sigma_2 >= sigma_3, tension positive, so that in plane
    // stress the 0 across the plane is one of them.

    /// sigma_1 / f_t (VNOSB eq. 17).
    double maximum_tensile_stress(const Stress &stress, const double tensile, const double)
    {
      return 1. / tensile * dealii::eigenvalues(stress)[0];
    }

    /// sigma_1 / f_t - sigma_3 / f_c (VNOSB eq. 18), which is tau = c cos(phi) - (sigma_1 + sigma_3)/2
    /// sin(phi), tau = (sigma_1 - sigma_3)/2, with the cohesion c = sqrt(f_t f_c)/2 and the angle of internal
    /// friction sin(phi) = (f_c - f_t)/(f_c + f_t) that make both uniaxial strengths come out. The plus sign
    /// printed in (18) is that of compression counted positive: with tension positive it would make a pull
    /// stronger than a push.
    double mohr_coulomb(const Stress &stress, const double tensile, const double compressive)
    {
      const auto principal = dealii::eigenvalues(stress);
      return 1. / tensile * principal[0] - 1. / compressive * principal[2];
    }

    /// (sqrt(J_2) + a I_1) / k (Drucker and Prager 1952), I_1 the trace of the stress, J_2 half the square of
    /// its deviator, with the a = (f_c - f_t)/(sqrt(3) (f_c + f_t)) and k = 2 f_c f_t/(sqrt(3) (f_c + f_t))
    /// that make both uniaxial strengths come out. Equal strengths are those of von Mises.
    double drucker_prager(const Stress &stress, const double tensile, const double compressive)
    {
      const double von_mises = std::sqrt(1.5) * deviator(stress).norm();
      return ((compressive + tensile) * von_mises + (compressive - tensile) * trace(stress)) /
             (2. * compressive * tensile);
    }
  } // namespace

  /// The list of criteria: a new one is one function and one line here.
  template <>
  const Registry<StressCriterionTraits> &FailureCriterion::list()
  {
    static const auto criteria = list_by_name<StressCriterionTraits>(
      "Material/Failure criterion",
      {{"none", "", false, nullptr},
       {"maximum tensile stress",
        "where the largest principal stress reaches Tensile strength",
        false,
        &maximum_tensile_stress},
       {"Mohr-Coulomb",
        "where sigma_1/f_t - sigma_3/f_c reaches 1, which has both strengths",
        true,
        &mohr_coulomb},
       {"Drucker-Prager",
        "a cone about the line of equal principal stresses, by both strengths",
        true,
        &drucker_prager}});
    return criteria;
  }

  StressCriterion::StressCriterion(const FailureCriterion &criterion,
                                   const double            tensile_strength,
                                   const double            compressive_strength)
    : criterion(criterion)
    , tensile(tensile_strength)
    , compressive(compressive_strength)
  {
    Assert(can_fail(), dealii::ExcMessage("a criterion must be named"));
    Assert(tensile_strength > 0, dealii::ExcMessage("a strength must be positive"));
    Assert(!criterion->has_compressive_strength || compressive_strength >= tensile_strength,
           dealii::ExcMessage("the angle of internal friction would be negative"));
  }

  StressCriterion stress_criterion(const MaterialParameters &parameters, const MaterialProperties &material)
  {
    if (!parameters.has_criterion() || material.tensile_strength == 0)
      return {};
    return {parameters.failure_criterion, material.tensile_strength, material.compressive_strength};
  }
} // namespace perideal
