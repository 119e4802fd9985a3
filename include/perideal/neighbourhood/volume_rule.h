// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_neighbourhood_volume_rule_h
#define perideal_neighbourhood_volume_rule_h

#include <perideal/neighbourhood/families.h>

namespace perideal
{
  /// Decides how much of a neighbour's volume a family counts. The rules are those of the room quadrature.
  template <int dim>
  class VolumeRule
  {
  public:
    virtual ~VolumeRule() = default;

    /// Share of the volume of local node @p j that counts in the family of @p i, 0 to 1 [-]. Shares below
    /// negligible count as none, so that round-off makes no members.
    virtual double share(const Families<dim> &families, const LocalIndex i, const LocalIndex j) const = 0;

    static constexpr double negligible = 1e-10;
  };
} // namespace perideal

#endif
