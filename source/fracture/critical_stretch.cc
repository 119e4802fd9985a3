// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/fracture/critical_stretch.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace perideal
{
  double ordinary_critical_stretch(const ElasticConstants &constants,
                                   const double            fracture_energy,
                                   const double            horizon)
  {
    using dealii::numbers::PI;
    const double kappa = constants.bulk_modulus(), mu = constants.shear_modulus();
    const double stiffness = constants.assumption == PlaneAssumption::solid ?
                               3. * mu + std::pow(0.75, 4) * (kappa - 5. * mu / 3.) :
                               6. * mu / PI + 16. / (9. * PI * PI) * (kappa - 2. * mu);
    return std::sqrt(fracture_energy / (stiffness * horizon));
  }

  double tensor_critical_stretch(const ElasticConstants &constants,
                                 const double            fracture_energy,
                                 const double            horizon)
  {
    using dealii::numbers::PI;
    const int    dim = constants.assumption == PlaneAssumption::solid ? 3 : 2;
    const double resistance =
      ((dim + 1) * constants.lame_lambda() + (dim + 3) * constants.shear_modulus()) / (dim + 2);
    return std::sqrt((dim == 3 ? 2. : PI) * fracture_energy / (3. * resistance * horizon));
  }
} // namespace perideal
