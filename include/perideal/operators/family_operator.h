// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_family_operator_h
#define perideal_operators_family_operator_h

#include <perideal/base/lanes.h>
#include <perideal/neighbourhood/bond_list.h>
#include <perideal/operators/bond_operator.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * The loop for models of one family shape. A bond stores, for each sum, the
   * weight of either end, and one stiffness; its vector is recomputed from
   * the positions, which is faster than loading it.
   */
  template <int dim, unsigned int n_sums, bool own_force_weights>
  class FamilyOperator : public BondOperator<dim>
  {
  public:
    FamilyOperator(const std::shared_ptr<const Families<dim>>                    &families,
                   LinearModel<dim>                                              &model,
                   const std::function<Moduli(const dealii::types::material_id)> &moduli);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> diagonal_blocks() const override;
    void                assemble(const typename BondOperator<dim>::AddBlock &add) const override;
    void                visit_bond_forces(const typename BondOperator<dim>::VisitBond &visit) const override;
    std::vector<double> dilatation() const override
    {
      return {sums[0].begin(), sums[0].begin() + families->n_owned()};
    }
    bool        is_symmetric() const override { return symmetric; }
    std::size_t memory_consumption() const override;

  private:
    /// Values of the two ends of every bond, by slot.
    struct Ends
    {
      std::vector<double> near, far;
    };
    using Weights = std::array<Ends, n_sums>;

    void weigh_families(LinearModel<dim>                                              &model,
                        const std::function<Moduli(const dealii::types::material_id)> &moduli);
    void store(const LocalIndex                    i,
               const FamilyCoefficients           &coefficients,
               const std::vector<BondCursor::End> &ends);
    void import_displacement(const NodalVector &displacement) const;
    void sum_over_families() const;
    void turn_sums_into_states() const;
    void sum_forces() const;

    const Weights &force_weights() const
    {
      if constexpr (own_force_weights)
        return force_weight;
      else
        return sum_weight;
    }

    dealii::Tensor<1, dim> bond_vector(const LocalIndex i, const LocalIndex j) const
    {
      return families->position[j] - families->position[i];
    }

    /// map s, the states of a node from its sums.
    std::array<double, n_sums> states(const LocalIndex i, const std::array<double, n_sums> &s) const;

    std::shared_ptr<const Families<dim>> families;
    BondList                             bonds;
    bool                                 symmetric;

    Weights             sum_weight;
    Weights             force_weight;
    std::vector<double> stiffness;
    /// Map from sums to states by local node (ghosts included for the diagonal).
    std::vector<std::array<double, 3>> map;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> state_partitioner;

    // Work space of vmult().
    dealii::AlignedVector<NodeRecord>               positions;
    mutable dealii::AlignedVector<NodeRecord>       displacements, forces;
    mutable std::array<std::vector<double>, n_sums> sums;
    mutable std::array<std::vector<double>, n_sums> state;
    mutable NodalVector                             ghosted, ghosted_states;
  };

  /// Calls a macro with every family shape there is: dim, n_sums, own_force_weights.
#define PERIDEAL_FOR_FAMILY_SHAPES(CALL)                                                                     \
  CALL(2, 1, false)                                                                                          \
  CALL(2, 1, true)                                                                                           \
  CALL(2, 2, false)                                                                                          \
  CALL(3, 1, false)                                                                                          \
  CALL(3, 1, true)                                                                                           \
  CALL(3, 2, false)
} // namespace perideal

#endif
