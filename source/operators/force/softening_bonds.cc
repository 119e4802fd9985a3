// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/operators/force/softening_bonds.h>

#include <deal.II/base/memory_consumption.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace perideal
{
  SofteningBonds::SofteningBonds(const SofteningLaw &law, const std::vector<float> &limits)
    : law(law)
    , shares(limits.size(), 1.f)
    , first(limits)
    , brittle_square(limits.size(), std::numeric_limits<float>::infinity())
    , waiting(law.waits() ? limits.size() : 0, false)
    , is_started(waiting)
  {
  }

  void SofteningBonds::begin_at(const BondIndex slot, const float given, float &limit)
  {
    const double square  = static_cast<double>(limit) * limit;
    brittle_square[slot] = static_cast<float>(square);
    first[slot]          = limit;
    // Bonds that never break do not soften either.
    if (!(square <= std::numeric_limits<float>::max()))
      return;
    if (law.waits())
      {
        waiting[slot] = true;
        first[slot]   = given;
        limit         = never;
      }
    else if (law.is_stable(given, square))
      first[slot] = limit = given;
  }

  void SofteningBonds::start(const BondIndex slot, const double stretch, float &limit)
  {
    Assert(waits(slot), dealii::ExcInternalError());
    waiting[slot]    = false;
    is_started[slot] = true;
    first[slot] = limit = static_cast<float>(stretch);
  }

  void SofteningBonds::restore(const BondIndex slot, const SoftenedBond &bond, float &limit)
  {
    double last = bond.limit, left = bond.share;
    if (!bond.is_limit_known())
      {
        const double begins = waits(slot) ? bond.first : first[slot], square = brittle_square[slot];
        if (!(square <= std::numeric_limits<float>::max()) || !law.is_stable(begins, square))
          return;
        last = law.stretch_bearing(bond.borne(), begins, square);
        left = bond.borne() * begins / last;
      }
    if (waits(slot))
      start(slot, bond.first, limit);
    shares[slot] = static_cast<float>(left);
    limit        = static_cast<float>(last);
  }

  void SofteningBonds::begin(std::vector<float> &limits)
  {
    // The last change of a bond first, should it have changed twice.
    if (!judged)
      for (auto trial = now.rbegin(); trial != now.rend(); ++trial)
        {
          limits[trial->slot] = trial->limit;
          shares[trial->slot] = trial->share;
        }
    judged = judges;
    now.clear();
  }

  bool SofteningBonds::any_now(MPI_Comm communicator) const
  {
    return dealii::Utilities::MPI::max(now.empty() ? 0u : 1u, communicator) > 0;
  }

  SofteningBonds::Change SofteningBonds::soften(const BondIndex slot, const double stretch, float &limit)
  {
    if (!softens())
      return {};
    now.push_back({slot, limit, shares[slot]});
    Change result;
    result.before = shares[slot];
    result.after  = law.is_stable(first[slot], brittle_square[slot]) ?
                      std::min(result.before, law.carried(stretch, first[slot], brittle_square[slot])) :
                      0.;
    shares[slot]  = static_cast<float>(result.after);
    result.after  = shares[slot];
    result.breaks = judges && result.after == 0;
    limit         = static_cast<float>(stretch);
    return result;
  }

  SofteningBonds::Left SofteningBonds::left(const BondIndex slot, const double stretch) const
  {
    Left result;
    result.share     = share(slot);
    result.stiffness = stiffness_left(slot, stretch);
    // On its way down, it is what the law says of this stretch.
    if (stretch > 0 && result.share > 0 && result.share < 1 &&
        std::abs(law.carried(stretch, first[slot], brittle_square[slot]) - result.share) <= 1e-6)
      result.slope = law.slope(stretch, first[slot], brittle_square[slot]);
    return result;
  }

  std::size_t SofteningBonds::memory_consumption() const
  {
    using dealii::MemoryConsumption::memory_consumption;
    return memory_consumption(shares) + memory_consumption(first) + memory_consumption(brittle_square) +
           memory_consumption(waiting) + memory_consumption(is_started) + now.capacity() * sizeof(Trial);
  }
} // namespace perideal
