// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_switching_force_h
#define perideal_operators_force_switching_force_h

#include <perideal/base/types.h>

namespace perideal
{
  /// What a force tells of itself that may become one of other bonds and cells, as ZonedForce does; one that
  /// does not keeps what stands here.
  class SwitchingForce
  {
  public:
    virtual ~SwitchingForce() = default;

    /// Lets bonds take the place of cells where they come near to breaking at the displacement of the last
    /// compute(), which does so by itself while it looks for bonds to break, and lets those begin to soften
    /// that wait for a stress. Returns whether that changed the force, which is then to be computed again;
    /// its version() tells whether it is another one at the last equilibrium, too. Collective.
    virtual bool extend_bonds(const NodalVector &) { return false; }

    /// How often bonds took the place of cells.
    virtual unsigned int version() const { return 0; }

    /// As BondForce::released_energy(), what that took out of the energy in the last compute(). Collective.
    virtual double switched_energy(const NodalVector &, const double) const { return 0.; }
  };
} // namespace perideal

#endif
