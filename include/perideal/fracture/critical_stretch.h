// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fracture_critical_stretch_h
#define perideal_fracture_critical_stretch_h

#include <perideal/parameters/elastic_constants.h>

namespace perideal
{
  /**
   * Stretch at which a bond of an ordinary state-based material breaks, so that
   * opening a unit of crack surface takes the fracture energy [-].
   *
   *     3-D: s0^2 = G0 / ((3 mu + (3/4)^4 (kappa - 5 mu/3)) horizon)
   *     2-D: s0^2 = G0 / ((6 mu/pi + 16/(9 pi^2) (kappa - 2 mu)) horizon)
   *
   * (TIPD eqs. 43 and 56, where G stands for G0; Madenci and Oterkus 2014.)
   *
   * @param fracture_energy G0 [J/m^2]
   * @param horizon [m]
   */
  double ordinary_critical_stretch(const ElasticConstants &constants,
                                   const double            fracture_energy,
                                   const double            horizon);

  /**
   * The same for tensor-involved bonds (TIPD eqs. 41 and 54, and for any symmetry):
   *
   *     3-D: s0^2 = 2 G0 / (3 B horizon),   2-D: s0^2 = pi G0 / (3 B horizon),
   *     B = ((dim+1) lambda + (dim+3) mu)/(dim+2),
   *
   * B being what a full sphere of bonds resists a stretch with, on the mean over the directions. That depends
   * on the traces of the stiffness only, which the nearest isotropic solid has in common with an anisotropic
   * one; there, a crack takes more than G0 across stiff directions and less across soft ones.
   *
   * @param constants of the nearest isotropic solid
   */
  double tensor_critical_stretch(const ElasticConstants &constants,
                                 const double            fracture_energy,
                                 const double            horizon);
} // namespace perideal

#endif
