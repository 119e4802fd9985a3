// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_bond_force_h
#define perideal_operators_force_bond_force_h

#include <perideal/base/lanes.h>
#include <perideal/operators/force/softening_bonds.h>
#include <perideal/operators/force/switching_force.h>
#include <perideal/operators/force/unknown_limits.h>
#include <perideal/operators/weights/family_weights.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  class LastingState;

  /**
   * Computes the force of the bonds in the deformed body, geometrically nonlinear: in the
   * terms of FamilyCoefficients, with e = |y_j - y_i| - |xi| and eps = |xi| e,
   *
   *     F = ( sum_a weight[a]_j A_a + stiffness_j eps_j ) |xi| (y_j - y_i)/|y_j - y_i|,
   *
   * of which BondOperator is the linearisation at rest. Bonds may break: a bond whose length
   * exceeds its limit loses all its weights, before the forces are summed, and for good. Or they soften: what
   * is left of a bond (SofteningLaw) counts in sums and force, as long as it is stretched; pressed together
   * it is whole.
   */
  template <int dim>
  class BondForce : public SwitchingForce
  {
  public:
    /// Stretch at which a bond between two local nodes breaks [-]; infinity: never.
    using CriticalStretch = std::function<double(const LocalIndex, const LocalIndex)>;

    /// Makes bonds breakable from now on.
    /// @param law by which they soften before, taking as much energy (not where they break by stress)
    /// @param first stretch where they begin to; may be empty where they break at once
    /// @param unknown of which bonds these are the least that they can be, until this is called again for the
    /// others of them; empty: all are known. Collective where it is not.
    virtual void set_critical_stretch(const CriticalStretch       &stretch,
                                      const SofteningLaw          &law     = SofteningLaw(),
                                      const CriticalStretch       &first   = {},
                                      const UnknownLimits::Source &unknown = {}) = 0;

    /// What softening has left of the bonds.
    virtual const SofteningBonds &softening_bonds() const { return softening; }

    /// What compute() makes of bonds beyond their limits, for good at first. A solver that goes through
    /// states which are no motion of the body lets it judge at equilibrium only.
    virtual void judge_bonds(const Judgement judgement) = 0;

    /// Weighs the families of some owned nodes anew, of which bonds have broken. Collective.
    using Reweigh =
      std::function<void(const std::vector<LocalIndex>                                 &nodes,
                         const std::function<bool(const LocalIndex, const LocalIndex)> &is_gone)>;

    /// From now on families that lose bonds are weighed anew. In steps in which bonds break, forces are
    /// computed twice.
    /// @param weights of this force, in which @p reweigh leaves the new ones
    virtual void reweigh_as_bonds_break(const std::shared_ptr<const BondWeights<dim>> &weights,
                                        const Reweigh                                 &reweigh) = 0;

    /// Takes out bonds, apart from damage, those that were weighed as cut among them; to be called once,
    /// before anything breaks. Returns their number on all ranks. Collective.
    virtual GlobalIndex cut(const BondPredicate<dim> &is_cut) = 0;

    /// Force on the owned nodes [N]. Collective.
    /// @param displacement of owned nodes [m]
    virtual void compute(NodalVector &force, const NodalVector &displacement) = 0;

    /// Forces that supports exert on the body at prescribed face values at the last compute() [N], by entry
    /// of FaceValues; none where the force carries none.
    virtual std::vector<dealii::Tensor<1, dim>> support_forces() const { return {}; }

    /// Receives a bond's nodes (the first owned) and the force it puts on the first [N].
    using VisitBond = std::function<void(const LocalIndex, const LocalIndex, const dealii::Tensor<1, dim> &)>;

    /// Shows the bond forces of the last compute() in the order of bond_list(); a bond that the partition
    /// cuts is shown on both ranks, from either end. Lost bonds pull with nothing.
    virtual void visit_bond_forces(const VisitBond &visit) const = 0;

    /// Registers what lasts: the bonds that broke, in their order; the memory of its law.
    virtual void register_state(LastingState &state) = 0;
    /// Breaks and softens bonds as they did before. Those that are no bonds here are left out. Collective.
    virtual void restore(const BondMemory &earlier) = 0;

    /// All bonds of this rank, broken ones included.
    virtual const BondList &bond_list() const = 0;

    /// Bonds of all nodes that hold the body together: these, or of forces with bonds where they may break
    /// only, the shortest ones.
    virtual const BondList &body_bonds() const { return bond_list(); }

    /// Bonds of all ranks that broke in the last compute(). Collective.
    virtual GlobalIndex n_broken_now() const = 0;

    /// Strain energy of all ranks at the last compute() [J]. Collective.
    virtual double strain_energy() const = 0;

    /**
     * What the breaking in the last compute() took out of the energy of leapfrog, m v(-).v(+)/2 + U,
     * of all ranks [J]:
     *
     *     U(before) - U(after) - dt/2 sum v(-).(f(after) - f(before)).
     *
     * Only the families of the broken bonds are looked at. Collective.
     * @param velocity v(-) of owned nodes, half a step before [m/s]
     */
    virtual double released_energy(const NodalVector &velocity, const double time_step) const = 0;

    /// A bond that carries no force any more.
    struct LostBond
    {
      BondIndex  slot;
      LocalIndex near, far;
    };

    /// The bonds of this rank that were cut or broke, in the order in which they went; one that the
    /// partition cuts stands on both ranks.
    virtual const std::vector<LostBond> &lost_bonds() const { return lost; }

    /// Takes weights anew. Collective.
    /// @param scaled weights of this force, scaled by @p share
    /// @param share of each family by local node: lost bonds stay lost, and where neither end has a share
    /// nothing is computed; empty: the weights know what is lost, and all are whole
    virtual void take_weights(const BondWeights<dim> &scaled, const std::vector<double> &share);

    /// Positions of the local nodes at the last compute(), ghosts included [m].
    virtual const NodeRecord *positions() const = 0;

    /// Dilatation at the last compute() by owned node; 0 where the model needs none.
    virtual std::vector<double> dilatation() const = 0;

    /// Share of the family's volume behind broken bonds by owned node, those that softened by what they lost,
    /// and behind those cut at the beginning.
    virtual std::vector<double> damage() const    = 0;
    virtual std::vector<double> cut_share() const = 0;

    /// How near the bonds of each owned node are to their limits at the last compute() [-]: the largest
    /// stretch, or strain, over the one at which the first of them begins to soften or breaks; of one that
    /// has softened 1 and the share of its largest force that it has lost; zero where nothing breaks.
    /// Collective.
    virtual std::vector<double> utilisation() const = 0;

    /// Mean share of the bonds that compute() has looked at; the others were at rest. Collective.
    virtual double share_computed() const = 0;

    virtual std::size_t memory_consumption() const = 0;

    /// A vector over owned nodes.
    void initialize(NodalVector &vector) const { vector.reinit(partitioner); }

  protected:
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    std::vector<LostBond>                                      lost;
    SofteningBonds                                             softening;
  };

  /// Creates the force of weighed bonds; it keeps its own copy of their weights.
  template <int dim>
  std::unique_ptr<BondForce<dim>> create_bond_force(const BondWeights<dim> &weights);
} // namespace perideal

#endif
