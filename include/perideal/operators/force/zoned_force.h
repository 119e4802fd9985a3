// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_zoned_force_h
#define perideal_operators_force_zoned_force_h

#include <perideal/operators/force/breaking_bonds.h>
#include <perideal/operators/force/consistent_force.h>
#include <perideal/operators/force/fracture_zone.h>
#include <perideal/operators/force/stress_onset.h>
#include <perideal/operators/force/wrapped_bonds.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Computes the force of a body that has the consistent form where it is whole and long families of bonds
   * where it cracks, - dU/du of
   *
   *     U = sum_i (1 - chi_i) (energy of cell i) + 1/2 sum_bonds (1 - (chi_i + chi_j)/2) b_ij r_ij^2
   *         + sum_i chi_i (energy of family i),
   *
   * with chi of a FractureZone, which grows ahead of what breaks: around nodes whose strain comes near to
   * that at which the first of their bonds would begin to fail. It grows where bonds are looked at, at each
   * step of a motion and at equilibria: states between these are none of the body, and a force that changes
   * while its equilibrium is sought may not have one. Both forms store the same in uniform strain, so that
   * growth changes the energy in second order of the cells' size, most at the tips of cracks; what it does
   * change is booked.
   *
   * Where bonds wait for a stress (StressOnset), they are told when to begin where the zone is looked at.
   *
   * Whole families are made on demand: of nodes with a chi, of their members, with which they share the bonds
   * whose stretches they decide on, and of some more, so that they need not be made at each growth; and where
   * bonds are cut. All others list only the bonds that stabilise cells.
   */
  template <int dim>
  class ZonedForce : public WrappedBonds<dim>, public ContinuumForce<dim>
  {
  public:
    /// Share of the strain at which a bond would begin to fail that makes the zone grow around its node [-].
    static constexpr double near_to_breaking = 0.5;
    /// Where one grows, nodes with so much of that make it grow too: of nodes that are equal, rounding does
    /// not choose one, and it grows less often, in less strain. With .98 Kalthoff's plate takes a quarter
    /// more time and switches half as much energy again.
    static constexpr double alike = 0.8;

    /// Returns the weights of the whole families of some nodes, which will change.
    using Weigh =
      std::function<std::shared_ptr<const BondWeights<dim>>(const std::shared_ptr<const Families<dim>> &)>;

    /// @param families of all nodes
    /// @param held where prescribed values at faces of this rank act on cells, and their spacing
    /// @param all_at_once whether whole families are those of all nodes from the beginning. Collective.
    ZonedForce(std::unique_ptr<ConsistentForce<dim>>                     cells,
               const std::shared_ptr<const Families<dim>>               &families,
               const Weigh                                              &weigh,
               const std::vector<std::pair<dealii::Point<dim>, double>> &held,
               const bool                                                all_at_once = false);

    /// When bonds fail.
    struct Limits
    {
      /// Sets the limits of bonds of whole families.
      std::function<void(const Families<dim> &, BondForce<dim> &)> set;
      /// Strain of a local node at which bonds like its own begin to fail [-]; infinity: never.
      std::function<double(const LocalIndex)> first_strain;
      /// For which stress bonds wait.
      typename StressOnset<dim>::Criterion criterion = {};
    };
    /// Makes bonds breakable from now on. Collective.
    void set_limits(const Limits &limits);
    /// Not for this force: limits are set again where families are made.
    void set_critical_stretch(const typename BondForce<dim>::CriticalStretch &,
                              const SofteningLaw &,
                              const typename BondForce<dim>::CriticalStretch &,
                              const UnknownLimits::Source &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }
    GlobalIndex cut(const BondPredicate<dim> &is_cut) override;

    void judge_bonds(const Judgement judgement) override;
    void compute(NodalVector &force, const NodalVector &displacement) override;
    bool extend_bonds(const NodalVector &displacement) override;

    std::vector<dealii::Tensor<1, dim>> support_forces() const override { return cells->support_forces(); }
    void                                register_state(LastingState &state) override;
    double                              strain_energy() const override;
    unsigned int                        version() const override { return zone.version(); }
    double              switched_energy(const NodalVector &velocity, const double time_step) const override;
    std::vector<double> dilatation() const override { return cells->dilatation(); }
    std::vector<double> utilisation() const override;
    std::size_t         memory_consumption() const override;

    /// Of cells, and in the zone, where faces open that cells do not know, by intact_gradients().
    std::vector<dealii::Tensor<2, dim>> gradients() const override;
    ExpandedLaw<dim>                    law(const LocalIndex i) const override { return cells->law(i); }

    /// What there is besides bond_force(): the cells, the weights of the bonds as they are scaled, and where
    /// which of them counts.
    const ConsistentForce<dim>                    &cell_force() const { return *cells; }
    const std::shared_ptr<const BondWeights<dim>> &scaled_weights() const { return scaled; }
    const FractureZone<dim>                       &fracture_zone() const { return zone; }

    const BondList &body_bonds() const override { return cells->bond_list(); }

    /// The nodes of all ranks whose whole families have been made, bytes that these and their bonds take on
    /// all ranks, and seconds that it took to make them, again where there were more [s].
    struct WholeFamilies
    {
      GlobalIndex nodes   = 0;
      std::size_t bytes   = 0;
      double      seconds = 0;
    };
    /// Collective.
    WholeFamilies whole_families() const;

  private:
    using WrappedBonds<dim>::bonds;

    /// Lets the zone grow around nodes and keeps what that changes at this displacement, where the cells were
    /// computed last; returns whether it did. Collective.
    bool grow(const std::vector<LocalIndex> &nodes, const NodalVector &displacement);
    /// Makes the bonds of the chosen families, with what is cut, broken and softened. Collective.
    void make_bonds();
    /// Gives bonds their shares. Collective.
    void scale_bonds();

    std::unique_ptr<ConsistentForce<dim>>   cells;
    std::shared_ptr<const Families<dim>>    families;
    std::shared_ptr<const BondWeights<dim>> whole, scaled;
    FractureZone<dim>                       zone;

    /// What makes bonds, and by local node whose whole families there are, and whose members have them too.
    struct Making
    {
      Weigh                                                        weigh;
      BondPredicate<dim>                                           is_cut;
      std::function<void(const Families<dim> &, BondForce<dim> &)> set_limits;
      std::vector<bool>                                            chosen, is_inside;
      GlobalIndex                                                  n_cut   = 0;
      double                                                       seconds = 0;
    };
    Making making;
    /// Strain at which bonds of an owned node begin to fail [-].
    std::vector<double> limit;
    StressOnset<dim>    onset;
    Judgement           judgement = Judgement::for_good;

    NodalVector of_cells;
    /// What the growth in the last compute() has added to the force [N] and taken from the energy [J].
    struct Change
    {
      bool        is_there = false;
      NodalVector force;
      double      energy = 0;
    };
    Change change;
  };
} // namespace perideal

#endif
