// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_breaking_bonds_h
#define perideal_operators_force_breaking_bonds_h

#include <perideal/base/lanes.h>
#include <perideal/operators/force/bond_force.h>
#include <perideal/operators/force/lost_volumes.h>
#include <perideal/operators/force/rest_regions.h>
#include <perideal/operators/force/softening_onset.h>

#include <deal.II/base/aligned_vector.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /// Returns the stretch of a bond between two positions [-].
  template <int dim>
  double stretch_between(const NodeRecord &near, const NodeRecord &far, const double rest_length)
  {
    double square = 0;
    for (int d = 0; d < dim; ++d)
      {
        const double along = far.value[d] - near.value[d];
        square += along * along;
      }
    return std::sqrt(square) / rest_length - 1.;
  }

  /**
   * Holds what every BondForce has besides the forces: the present positions of the nodes, the bonds with
   * their lengths at rest, the stretches at which they break, and which of them broke.
   */
  template <int dim>
  class BreakingBonds : public BondForce<dim>
  {
  public:
    void        set_critical_stretch(const typename BondForce<dim>::CriticalStretch &stretch,
                                     const SofteningLaw                             &law     = SofteningLaw(),
                                     const typename BondForce<dim>::CriticalStretch &first   = {},
                                     const UnknownLimits::Source                    &unknown = {}) override;
    void        judge_bonds(const Judgement judgement) override;
    GlobalIndex cut(const BondPredicate<dim> &is_cut) override;
    GlobalIndex n_broken_now() const override;
    void        register_state(LastingState &state) override
    {
      register_bonds(state, [this]() -> BreakingBonds & { return *this; });
    }
    const BondList     &bond_list() const override { return bonds; }
    const NodeRecord   *positions() const override { return position.data(); }
    std::vector<double> damage() const override;
    std::vector<double> cut_share() const override { return volumes.share(volumes.cut); }
    std::vector<double> utilisation() const override;
    double              share_computed() const override { return regions.share_awake(); }

    /// What softened without being judged is taken back first.
    BondMemory memory();
    void       restore(const BondMemory &earlier) override;

    /// Registers the memory of the bonds that are there when it is asked for.
    static void register_bonds(LastingState &state, const std::function<BreakingBonds &()> &bonds);

    /// Starts the softening of the waiting bonds that begin or end in the cells of owned nodes, or pass
    /// through them: a crack there crosses them. Returns whether a bond started. Collective.
    /// @param onset when, by node
    /// @param borne displacement of the last state that was judged, by local component, which all waiting
    /// bonds bore: none starts below that [m]
    bool start_softening(const std::vector<SofteningOnset> &onset, const NodalVector &borne);

  protected:
    /// @param has_sums whether forces need sums over families first
    /// @param has_lengths whether anyone asks for lengths of bonds: not where none breaks
    BreakingBonds(const std::shared_ptr<const Families<dim>> &families,
                  const BondList                             &bonds,
                  const bool                                  has_sums,
                  const bool                                  has_lengths = true);

    /// False of padding, and of bonds that were cut or broke.
    virtual bool carries_force(const BondIndex slot) const = 0;
    /// Makes all weights of a bond zero.
    virtual void clear_weights(const BondIndex slot) = 0;

    /// Breaks bonds again that broke in an earlier run. Those that are no bonds here are left out.
    virtual void restore_broken(const std::vector<BondEnds> &broken);

    /// Whether compute() has to look for bonds that break or soften.
    bool can_break() const
    {
      return !critical_stretch.empty() &&
             (judgement == Judgement::for_good || (judgement == Judgement::on_trial && softening.softens()));
    }

    /// Takes the displacement; from here on bonds break now. Collective.
    /// @param records of the local nodes, which get the displacement itself where a force needs it; may be
    /// null
    /// @param some owned nodes beyond which none has moved since the last call; null: any may
    void move_nodes(const NodalVector                 &displacement,
                    dealii::AlignedVector<NodeRecord> *records = nullptr,
                    const std::vector<LocalIndex>     *some    = nullptr);

    /// Finds out the limits that were asked for since the last call, and more. Returns whether there were
    /// such: what fails is then to be looked at again. Collective.
    /// @param anyway whether all bonds are looked at even so
    bool find_out_limits(const bool anyway = false);

    /// Softens or breaks a bond of this stretch, which is beyond its limit; the caller has looked at its
    /// weights.
    SofteningBonds::Change overstretch(const BondIndex slot, const LocalIndex near, const double stretch);

    /// Takes out a bond, the weights of which the caller has looked at: it breaks, or is cut.
    void break_bond(const BondIndex slot, const LocalIndex near, const bool is_cut = false);

    std::size_t breaking_memory() const;

    using BondForce<dim>::softening;

    std::shared_ptr<const Families<dim>> families;
    BondList                             bonds;
    /// Lengths at rest by slot [m].
    std::vector<double> rest_length;
    /// Stretches beyond which bonds break or go on to soften, by slot; empty where nothing breaks.
    std::vector<float>                critical_stretch;
    UnknownLimits                     unknown;
    RestRegions                       regions;
    dealii::AlignedVector<NodeRecord> position, forces;

  private:
    Judgement        judgement = Judgement::for_good;
    LostVolumes<dim> volumes;
    /// Of the lost bonds, those that were cut at the beginning, and those lost before the last compute().
    struct Lost
    {
      std::size_t cut = 0, before = 0;
    };
    Lost        n_lost;
    NodalVector ghosted;
  };
} // namespace perideal

#endif
