// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_softening_onset_h
#define perideal_operators_force_softening_onset_h

#include <perideal/base/types.h>

#include <algorithm>

namespace perideal
{
  /**
   * Tells at which stretch bonds of a node begin to soften, so that its family bears the stress at which its
   * material fails. Bonds are calibrated for this under a uniaxial stress (BulkStrength): inclined ones are
   * stretched less and go on to load when the first begin, which is at a share r of the strain. If all
   * directions are stretched alike, all bonds begin at once, and r is 1; in shear it is less than r. Between
   * the share goes with the contraction across the largest strain.
   */
  struct SofteningOnset
  {
    /// Of this rank, which others are not told.
    LocalIndex node = 0;
    /// The largest strain, if it grows in proportion, with which the strength is reached [-].
    double strain = 0;
    /// The contraction across it over the strain [-].
    double lateral = 0;
    /// The same under a uniaxial stress.
    double uniaxial_strain = 0, uniaxial_lateral = 0;

    /// Returns the stretch at which a bond begins to soften [-].
    /// @param calibrated that under a uniaxial stress
    double first_stretch(const double calibrated) const
    {
      // Beyond shear, under pressure, the family splits, and bears nothing along the largest strain.
      constexpr double least = 0.5;
      const double     share =
        1. + (calibrated / uniaxial_strain - 1.) * (1. + lateral) / (1. + uniaxial_lateral);
      return std::clamp(share, least, 1.) * strain;
    }

    template <typename Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &strain &lateral &uniaxial_strain &uniaxial_lateral;
    }
  };
} // namespace perideal

#endif
