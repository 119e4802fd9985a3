// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/parameters/elastic_constants.h>

namespace perideal
{
  ElasticConstants ElasticConstants::of_moduli(const double          bulk_modulus,
                                               const double          shear_modulus,
                                               const PlaneAssumption assumption)
  {
    const int    dim    = assumption == PlaneAssumption::solid ? 3 : 2;
    const double lambda = bulk_modulus - 2. * shear_modulus / dim;
    const double nu = assumption == PlaneAssumption::plane_stress ? lambda / (lambda + 2. * shear_modulus) :
                                                                    lambda / (2. * (lambda + shear_modulus));
    return {2. * shear_modulus * (1. + nu), nu, assumption};
  }

  double ElasticConstants::shear_modulus() const
  {
    return young_modulus / (2. * (1. + poisson_ratio));
  }

  double ElasticConstants::bulk_modulus() const
  {
    switch (assumption)
      {
      case PlaneAssumption::plane_stress:
        return young_modulus / (2. * (1. - poisson_ratio));
      case PlaneAssumption::plane_strain:
        return young_modulus / (2. * (1. + poisson_ratio) * (1. - 2. * poisson_ratio));
      default:
        return young_modulus / (3. * (1. - 2. * poisson_ratio));
      }
  }

  double ElasticConstants::lame_lambda() const
  {
    const int dim = assumption == PlaneAssumption::solid ? 3 : 2;
    return bulk_modulus() - 2. * shear_modulus() / dim;
  }
} // namespace perideal
