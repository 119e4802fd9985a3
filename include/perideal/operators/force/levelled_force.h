// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_levelled_force_h
#define perideal_operators_force_levelled_force_h

#include <perideal/base/types.h>
#include <perideal/operators/force/local_steps.h>
#include <perideal/operators/force/rest_regions.h>

#include <limits>
#include <memory>
#include <vector>

namespace perideal
{
  /// A force that can be computed in parts, by the levels of local steps.
  class LevelledForce
  {
  public:
    virtual ~LevelledForce() = default;

    /// Of one level.
    struct Part
    {
      /// On owned nodes [N].
      NodalVector force;
      /// What supports exert at prescribed values at faces [N], by component of the entries
      /// (LocalSteps::levels_of_supports()).
      std::vector<double> support;
    };

    void take_local_steps(const std::shared_ptr<const LocalSteps> &steps) { local_steps = steps; }

    /// Computes the force on the owned nodes as far as the levels up to one; in the sum of these parts
    /// nothing is missing that nodes of these levels change. No bond fails. With less than all levels, sums
    /// and energies are not those of the body. Collective.
    /// @param parts by level; higher ones stay as they are @param displacement of owned nodes [m]
    virtual void
    compute_parts(std::vector<Part> &parts, const NodalVector &displacement, const unsigned int highest) = 0;

  protected:
    /// Those whose blocks a pass over the bonds goes over; without local steps, all.
    struct Levels
    {
      unsigned int first = 0, last = std::numeric_limits<unsigned int>::max();
    };

    /// Whether a row is the first of a block that such a pass has nothing to do in.
    /// @param is_awake of a block
    template <typename IsAwake>
    bool skips(const LocalIndex row, const Levels levels, const IsAwake &is_awake) const
    {
      if (row % RestRegions::block_size != 0)
        return false;
      const LocalIndex block = row / RestRegions::block_size;
      if (!is_awake(block))
        return true;
      if (!local_steps)
        return false;
      const unsigned int level = local_steps->level_of_block(block);
      return level < levels.first || level > levels.last;
    }

    /// Null where all nodes take the same step.
    std::shared_ptr<const LocalSteps> local_steps;
  };
} // namespace perideal

#endif
