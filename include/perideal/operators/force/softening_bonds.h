// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_softening_bonds_h
#define perideal_operators_force_softening_bonds_h

#include <perideal/base/lanes.h>
#include <perideal/base/types.h>
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/parameters/softening.h>

#include <deal.II/base/mpi.h>

#include <vector>

namespace perideal
{
  /// What becomes of bonds beyond their limits.
  enum class Judgement
  {
    /// They stay as they are.
    none,
    /// Those that soften have what a state leaves them if the body came to it from the last equilibrium.
    on_trial,
    /// They break or soften.
    for_good
  };

  /// What lasts of a bond that softened or was started: the stretch beyond which it goes on to soften, the
  /// share of its weights that is left, and the stretch at which it began [-].
  struct SoftenedBond
  {
    static constexpr unsigned int n_values = 3;

    /// One of which it is known only what it bears, over its largest force.
    static SoftenedBond bearing(const double force, const double first) { return {0., force, first}; }

    double limit, share, first;

    bool is_limit_known() const { return limit > 0; }
    /// The force that it bears where it goes on to soften, over its largest [-].
    double borne() const { return is_limit_known() ? share * limit / first : share; }
  };

  /// What lasts of bonds: those of a rank that broke, in this order (those that the partition cuts are on
  /// both ranks), and those that softened, with the numbers of a SoftenedBond each.
  struct BondMemory
  {
    static constexpr char name_of_softened[] = "softened bonds";

    std::vector<BondEnds> broken, softened;
    std::vector<double>   of_softened;

    void add(const BondEnds &ends, const SoftenedBond &bond)
    {
      softened.push_back(ends);
      of_softened.insert(of_softened.end(), {bond.limit, bond.share, bond.first});
    }

    static SoftenedBond bond(const std::vector<double> &values, const std::size_t b)
    {
      const double *of_bond = values.data() + SoftenedBond::n_values * b;
      return {of_bond[0], of_bond[1], of_bond[2]};
    }
  };

  /**
   * Keeps what is left of bonds that soften (SofteningLaw), by slot: a share of all their weights. Pressed
   * together, a bond resists its shortening like a whole one; its part in the sums of its families stays what
   * is left, so that force and energy are continuous where a crack closes. The stretch beyond which a bond
   * goes on to soften is its limit, which the force holds that lengths are checked against.
   *
   * Where bonds are not judged, a change lasts until the next begin() only: each state is seen as if the body
   * came to it from the last one that was judged.
   *
   * Where the law waits, bonds soften no earlier than start() says.
   */
  class SofteningBonds
  {
  public:
    /// A stretch that no bond reaches, small enough for its product with a length to be finite [-].
    static constexpr float never = 1e30f;

    /// Bonds break at once.
    SofteningBonds() = default;

    /// @param limits of bonds none of which breaks yet
    SofteningBonds(const SofteningLaw &law, const std::vector<float> &limits);

    /// Lets a bond soften.
    /// @param first where it is to begin; where it could not open stably, it breaks at once
    /// @param limit its critical stretch if it breaks at once, which becomes that where it begins to soften
    void begin_at(const BondIndex slot, const float first, float &limit);

    bool softens() const { return law.softens(); }

    void judge(const bool for_good) { judges = for_good; }

    /// Whether a bond waits to be started.
    bool waits(const BondIndex slot) const { return !waiting.empty() && waiting[slot]; }
    /// Lets a waiting bond begin to soften at a stretch; where it could not open stably from there, it
    /// breaks.
    void start(const BondIndex slot, const double stretch, float &limit);

    /// Before the bonds of a state are looked at.
    void begin(std::vector<float> &limits);

    /// Whether a bond of any rank softened since begin(). Collective.
    bool any_now(MPI_Comm communicator) const;

    /// Shares of its weights that a bond had and has left.
    struct Change
    {
      double before = 1, after = 0;
      /// For good.
      bool breaks = true;
    };
    /// Softens a bond whose stretch is beyond its limit.
    Change soften(const BondIndex slot, const double stretch, float &limit);

    /// Share g of its weights that a bond has [-], what it has of its own stiffness at this stretch, and
    /// dg/ds where it goes on to soften.
    struct Left
    {
      double share = 1, stiffness = 1, slope = 0;
    };
    Left left(const BondIndex slot, const double stretch) const;

    /// The share g alone.
    double share(const BondIndex slot) const { return shares.empty() ? 1. : shares[slot]; }
    /// What a bond that is this much longer than at rest has of its own stiffness.
    double stiffness_left(const BondIndex slot, const double longer) const
    {
      return longer > 0 ? share(slot) : 1.;
    }
    /// The shares of four bonds.
    PERIDEAL_INLINE Lanes shares_of(const BondIndex first_slot) const
    {
      Lanes result;
      load(result, shares.data() + first_slot);
      return result;
    }

    /// Whether a bond is not what it was at the beginning: it has lost some of its weights, or was started.
    bool has_changed(const BondIndex slot) const
    {
      return softens() && shares[slot] > 0 && (shares[slot] < 1 || was_started(slot));
    }
    /// s_0, of bonds that wait as if a uniaxial stress was to start them.
    double first_stretch(const BondIndex slot) const { return first[slot]; }

    /// What lasts of a bond of this limit.
    SoftenedBond memory(const BondIndex slot, const float limit) const
    {
      return {limit, share(slot), first_stretch(slot)};
    }
    /// Sets what lasts of a bond. One of which only the force is known stays whole where it could not soften.
    void restore(const BondIndex slot, const SoftenedBond &bond, float &limit);

    std::size_t memory_consumption() const;

  private:
    bool was_started(const BondIndex slot) const { return !waiting.empty() && is_started[slot]; }

    SofteningLaw law;
    /// g, s_0 and s_d^2 of the law, by slot; empty where bonds break at once.
    std::vector<float> shares, first, brittle_square;
    /// Which bonds wait, and which did until they were started, by slot; empty where none ever waits.
    std::vector<bool> waiting, is_started;
    /// Whether changes are for good, and were so since begin().
    bool judges = true, judged = true;
    /// A bond that softened since begin(), with what it was before.
    struct Trial
    {
      BondIndex slot;
      float     limit, share;
    };
    std::vector<Trial> now;
  };
} // namespace perideal

#endif
