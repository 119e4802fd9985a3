// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/stress_criteria.h>

namespace perideal
{
  StressCriterion::StressCriterion(const FailureCriterion criterion,
                                   const double           tensile_strength,
                                   const double           compressive_strength)
    : per_tension(1. / tensile_strength)
    , per_compression(criterion == FailureCriterion::mohr_coulomb ? 1. / compressive_strength : 0.)
  {
    Assert(criterion != FailureCriterion::none, dealii::ExcMessage("a criterion must be named"));
    Assert(tensile_strength > 0, dealii::ExcMessage("a strength must be positive"));
    Assert(criterion != FailureCriterion::mohr_coulomb || compressive_strength >= tensile_strength,
           dealii::ExcMessage("the angle of internal friction would be negative"));
  }

  double StressCriterion::utilisation(const dealii::SymmetricTensor<2, 3> &stress) const
  {
    // In descending order.
    const auto principal = dealii::eigenvalues(stress);
    return per_tension * principal[0] - per_compression * principal[2];
  }

  StressCriterion stress_criterion(const MaterialParameters &parameters, const MaterialProperties &material)
  {
    if (!parameters.has_criterion() || material.tensile_strength == 0)
      return {};
    return {parameters.failure_criterion, material.tensile_strength, material.compressive_strength};
  }
} // namespace perideal
