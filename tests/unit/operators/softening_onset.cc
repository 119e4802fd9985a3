// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/softening_onset.h>

#include "testing.h"

using namespace perideal;

namespace
{
  /// A strain of 3e-4 that grows to reach the strength, with some contraction across it; under a uniaxial
  /// stress strength would be reached at 2e-4, and bonds are calibrated to begin at .7 of that.
  double first_stretch(const double lateral)
  {
    const SofteningOnset onset{0, 3e-4, lateral, 2e-4, 0.25};
    return onset.first_stretch(0.7 * 2e-4);
  }
} // namespace

TEST(SofteningOnset, UniaxialStressBeginsAsCalibrated)
{
  EXPECT_NEAR(first_stretch(0.25), 0.7 * 3e-4, 1e-18);
}

TEST(SofteningOnset, AllDirectionsBeginAtOnceWhereAllAreStretchedAlike)
{
  EXPECT_NEAR(first_stretch(-1.), 3e-4, 1e-18);
}

TEST(SofteningOnset, ShearBeginsEarlierAndPressureNoFurther)
{
  const double shear = first_stretch(1.);
  EXPECT_NEAR(shear, (1. - 0.3 * 2. / 1.25) * 3e-4, 1e-18);
  EXPECT_EQ(first_stretch(20.), 0.5 * 3e-4);
}
