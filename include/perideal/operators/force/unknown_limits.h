// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_unknown_limits_h
#define perideal_operators_force_unknown_limits_h

#include <perideal/base/types.h>

#include <deal.II/base/memory_consumption.h>

#include <functional>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Keeps which bonds have limits that are not known yet: the least that they can be stands for each, and
   * what they are is found out before a bond goes beyond that. Most bonds of most scenes never do, and
   * calibrating all families of a mesh without equal ones takes longer than the scene itself.
   */
  class UnknownLimits
  {
  public:
    /// Finds out the limits of the bonds between some local nodes, and of others, and sets them. Collective.
    using FindOut = std::function<void(const std::vector<bool> &nodes)>;

    /// What tells the limits.
    struct Source
    {
      /// Whether the limit of the bond between two local nodes is known.
      std::function<bool(const LocalIndex, const LocalIndex)> is_known;
      FindOut                                                 find_out;
    };

    /// Share of their limits that unknown ones are taken for when it is asked how near bonds come to them:
    /// .75 to .84 of families that bear a strength, .6 to .9 of others (calibrated_stretches.cc).
    static constexpr double share_of_limit = 0.75;
    /// Where one is beyond its limit, those that have so much of theirs are found out as well.
    static constexpr double alike = 0.8;

    /// All are known.
    UnknownLimits() = default;

    /// @param bonds which are not, by slot
    /// @param nodes between which bonds were asked for, by local number
    /// @param was_looked_at whether bonds have been looked at before
    UnknownLimits(FindOut how, std::vector<bool> bonds, std::vector<bool> nodes, const bool was_looked_at)
      : how(std::move(how))
      , bonds(std::move(bonds))
      , nodes(std::move(nodes))
      , was_looked_at(was_looked_at)
    {
    }

    /// Whether there are any, on this rank or another.
    bool are_there() const { return !nodes.empty(); }

    bool contains(const BondIndex slot) const { return !bonds.empty() && bonds[slot]; }

    /// Whether the limit of a bond beyond it is unknown, so that nobody can tell whether it fails: it is
    /// found out next.
    bool holds(const BondIndex slot)
    {
      const bool is_unknown = contains(slot);
      is_asked              = is_asked || is_unknown;
      return is_unknown;
    }

    /// Whether bonds are looked at for the first time, on all ranks. What a scene that goes on from a
    /// checkpoint knew before is to be found out before any bond breaks: the order in which bonds break
    /// counts in the last bits.
    bool take_first_look() { return are_there() && !std::exchange(was_looked_at, true); }

    /// Whether this rank asked for one. Until the next call.
    bool take_question() { return std::exchange(is_asked, false); }

    /// Finds out those of the bonds between nodes, and of those asked for before. Collective.
    void find_out(const std::vector<bool> &more)
    {
      for (LocalIndex i = 0; i < nodes.size(); ++i)
        nodes[i] = nodes[i] || more[i];
      // It sets the limits, and replaces this object.
      const FindOut           ask    = how;
      const std::vector<bool> wanted = nodes;
      ask(wanted);
    }

    const std::vector<bool> &asked_nodes() const { return nodes; }

    std::size_t memory_consumption() const
    {
      return dealii::MemoryConsumption::memory_consumption(bonds) +
             dealii::MemoryConsumption::memory_consumption(nodes);
    }

  private:
    FindOut           how;
    std::vector<bool> bonds, nodes;
    bool              is_asked = false, was_looked_at = false;
  };
} // namespace perideal

#endif
