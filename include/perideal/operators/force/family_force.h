// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_family_force_h
#define perideal_operators_force_family_force_h

#include <perideal/base/lanes.h>
#include <perideal/operators/force/breaking_bonds.h>
#include <perideal/operators/force/levelled_force.h>

#include <array>
#include <memory>
#include <vector>

namespace perideal
{
  /// The weight of a family's sum at an end of a bond; 0 of families without sums.
  template <unsigned int n_sums, typename Sums>
  double value_at_end(const Sums &sums, const unsigned int a, const BondCursor::End &end)
  {
    if constexpr (n_sums == 0)
      return 0.;
    else
      return (end.is_near ? sums[a].near : sums[a].far)[end.slot];
  }

  /**
   * Computes the nonlinear force of models of one family shape. Weights are kept in single precision, which
   * halves what the loops load; this perturbs the material by the rounding of single precision, in forces and
   * energy alike. They are kept over the largest, so that it is also the same in all units of length and
   * force, and nothing leaves the range of single precision. Lengths, sums and forces are in double
   * precision.
   */
  template <int dim, unsigned int n_sums, bool own_force_weights>
  class FamilyForce : public BreakingBonds<dim>, public LevelledForce
  {
  public:
    using Weights = FamilyWeights<dim, n_sums, own_force_weights>;

    explicit FamilyForce(const Weights &weights);

    void   reweigh_as_bonds_break(const std::shared_ptr<const BondWeights<dim>> &weights,
                                  const typename BondForce<dim>::Reweigh        &reweigh) override;
    void   take_weights(const BondWeights<dim> &scaled, const std::vector<double> &share) override;
    void   compute(NodalVector &force, const NodalVector &displacement) override;
    void   compute_parts(std::vector<LevelledForce::Part> &parts,
                         const NodalVector                &displacement,
                         const unsigned int                highest) override;
    void   visit_bond_forces(const typename BondForce<dim>::VisitBond &visit) const override;
    void   restore_broken(const std::vector<BondEnds> &broken) override;
    double strain_energy() const override;
    double released_energy(const NodalVector &velocity, const double time_step) const override;
    std::vector<double> dilatation() const override
    {
      if constexpr (n_sums == 0)
        return std::vector<double>(families->n_owned(), 0.);
      else
        return {sums[0].begin(), sums[0].begin() + families->n_owned()};
    }
    std::size_t memory_consumption() const override;

  private:
    using States = std::array<double, n_sums>;

    /// A bond that broke or softened in the last compute(), with the weights it lost.
    struct BrokenBond
    {
      BondIndex  slot;
      LocalIndex near, far;
      States     near_sum, far_sum, near_force, far_force;
      double     stiffness;

      void scale(const double share)
      {
        stiffness *= share;
        for (States *weights : {&near_sum, &far_sum, &near_force, &far_force})
          for (double &weight : *weights)
            weight *= share;
      }
    };

    /// Sums over a family before or after a break: with sum and force weights, and
    /// the rate of the latter.
    struct FamilySums
    {
      States sum = {}, force = {}, force_rate = {};
    };

    using BreakingBonds<dim>::families;
    using BreakingBonds<dim>::bonds;
    using BreakingBonds<dim>::rest_length;
    using BreakingBonds<dim>::critical_stretch;
    using BreakingBonds<dim>::regions;
    using BreakingBonds<dim>::position;
    using BreakingBonds<dim>::forces;
    using BreakingBonds<dim>::softening;

    bool carries_force(const BondIndex slot) const override;
    void clear_weights(const BondIndex slot) override;

    /// The weights as they are.
    double stiffness(const BondIndex slot) const { return unit.stiffness * weights.stiffness[slot]; }
    double sum_weight(const unsigned int a, const BondCursor::End &end) const
    {
      return unit.sum * value_at_end<n_sums>(weights.sum_weight, a, end);
    }
    double force_weight(const unsigned int a, const BondCursor::End &end) const
    {
      return unit.force * value_at_end<n_sums>(weights.force_weights(), a, end);
    }

    /// What compute() does to bonds that are too long.
    enum class Failing
    {
      not_at_all,
      at_once,
      gradually
    };
    /// Sums and forces of the bonds there are, after those too long have failed.
    template <Failing failing>
    void compute_forces(NodalVector &force);
    /// As compute_forces<at_once>(), with families weighed anew where bonds break.
    void compute_and_reweigh(NodalVector &force);
    /// Weighs the families of the owned ends of bonds anew.
    /// @param first of the lost bonds
    void reweigh_ends(const std::size_t first);

    /// The passes over the bonds, which add to sums and forces; lengths are checked in the first.
    template <Failing failing>
    void sum_over_families(const Levels levels);
    template <Failing failing>
    void sum_forces(const Levels levels);

    /// Breaks or softens those of a group of bonds that are too long.
    /// @param excess of their lengths over the largest ones [m]
    void break_bonds(const LocalIndex i, const BondIndex first_slot, const Lanes &excess);

    /// eps and its rate of one bond, from the end @p i.
    struct Motion
    {
      double eps, rate;
    };
    template <typename Velocity>
    Motion
    motion(const BondIndex slot, const LocalIndex i, const LocalIndex j, const Velocity &velocity) const;

    double family_energy(const LocalIndex i, const FamilySums &sums) const;

    /// Slots of the bonds of an owned node.
    std::vector<BondCursor::End> slots_of(const LocalIndex i) const;

    FamilyMaps<n_sums> map;
    /// In units.
    SlotWeights<float, n_sums, own_force_weights> weights;
    WeightUnits                                   unit;
    std::vector<double>                           energy;

    std::vector<BrokenBond> broken_now;
    /// Where families are weighed anew: how, what the breaking in the last compute() has added to the
    /// forces, and the energy before.
    typename BondForce<dim>::Reweigh        reweigh;
    std::shared_ptr<const Weights>          current_weights;
    NodalVector                             force_change;
    double                                  energy_before = 0;
    std::array<std::vector<double>, n_sums> sums, state;
    NodalVector                             ghosted_states;
  };
} // namespace perideal

#endif
