// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_parameters_engineering_constants_h
#define perideal_parameters_engineering_constants_h

#include <perideal/parameters/elastic_symmetry.h>

namespace perideal
{
  /// The stiffness in space [Pa], in the material's own axes, of a cubic, transversely isotropic or
  /// orthotropic material. Where plane stress leaves constants out, the plane is not coupled to what is
  /// across it.
  /// @throws InputError when constants are missing, too many, or those of no elastic solid.
  dealii::SymmetricTensor<4, 3> engineering_stiffness(const ElasticSymmetry &symmetry,
                                                      const PlaneAssumption  assumption);
} // namespace perideal

#endif
