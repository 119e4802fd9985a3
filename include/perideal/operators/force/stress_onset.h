// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_stress_onset_h
#define perideal_operators_force_stress_onset_h

#include <perideal/operators/force/breaking_bonds.h>
#include <perideal/operators/force/consistent_force.h>

#include <functional>
#include <utility>
#include <vector>

namespace perideal
{
  /**
   * Starts the softening of bonds that wait for a stress, where the consistent form has become one of bonds:
   * once the stress of a node comes near to its strength, the bonds through its cell are told the stretch at
   * which they begin (SofteningOnset). The stress is that of the bonds that are whole (intact_gradients()).
   */
  template <int dim>
  class StressOnset
  {
  public:
    /// When nodes fail.
    struct Criterion
    {
      /// Share of its strength that Cauchy's stress [Pa] takes of an owned node [-]; null: no bond waits.
      std::function<double(const LocalIndex, const dealii::SymmetricTensor<2, 3> &)> utilisation = {};
      /// The strain along the uniaxial stress that takes all of it, and the contraction across over that [-].
      std::function<std::pair<double, double>(const LocalIndex)> uniaxial = {};
    };

    /// No bond waits.
    StressOnset() = default;

    StressOnset(const Criterion &criterion, const LocalIndex n_owned)
      : criterion(criterion)
      , is_reached(n_owned, false)
    {
    }

    bool is_awaited() const { return static_cast<bool>(criterion.utilisation); }

    /// Keeps the displacement at the last compute() of the bonds as one that all bonds bore that wait.
    /// @param judged whether bonds were judged then; otherwise it is kept only if none was before
    void keep(const Families<dim> &families, const BondForce<dim> &bonds, const bool judged);

    /// Starts bonds of nodes that come near to their strength, as cells and bonds are at their last
    /// compute(); returns whether one did. Collective.
    /// @param chi share of the bonds in the energy, by local node
    bool start(const ConsistentForce<dim> &cells,
               const Families<dim>        &families,
               BreakingBonds<dim>         &bonds,
               const std::vector<double>  &chi);

  private:
    Criterion criterion;
    /// Owned nodes whose bonds do not wait any more.
    std::vector<bool> is_reached;
    /// The displacement of keep(), by local component [m].
    NodalVector borne;
  };
} // namespace perideal

#endif
