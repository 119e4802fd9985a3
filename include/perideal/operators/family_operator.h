// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_family_operator_h
#define perideal_operators_family_operator_h

#include <perideal/base/lanes.h>
#include <perideal/operators/bond_operator.h>
#include <perideal/operators/family_weights.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * The linear loops for models of one family shape. The vector of a bond is recomputed from
   * the positions, which is faster than loading it.
   */
  template <int dim, unsigned int n_sums, bool own_force_weights>
  class FamilyOperator : public BondOperator<dim>
  {
  public:
    explicit FamilyOperator(
      const std::shared_ptr<const FamilyWeights<dim, n_sums, own_force_weights>> &weights);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> diagonal_blocks() const override;
    void                assemble(const typename BondOperator<dim>::AddBlock &add) const override;
    void                visit_bond_forces(const typename BondOperator<dim>::VisitBond &visit) const override;
    std::vector<double> dilatation() const override
    {
      if constexpr (n_sums == 0)
        return std::vector<double>(families->n_owned(), 0.);
      else
        return {sums[0].begin(), sums[0].begin() + families->n_owned()};
    }
    bool        is_symmetric() const override { return weights->symmetric; }
    std::size_t memory_consumption() const override;

  private:
    void import_displacement(const NodalVector &displacement) const;
    void sum_over_families() const;
    void turn_sums_into_states() const;
    void sum_forces() const;

    dealii::Tensor<1, dim> bond_vector(const LocalIndex i, const LocalIndex j) const
    {
      return families->position[j] - families->position[i];
    }

    std::shared_ptr<const FamilyWeights<dim, n_sums, own_force_weights>> weights;
    std::shared_ptr<const Families<dim>>                                 families;

    // Work space of vmult().
    dealii::AlignedVector<NodeRecord>               positions;
    mutable dealii::AlignedVector<NodeRecord>       displacements, forces;
    mutable std::array<std::vector<double>, n_sums> sums;
    mutable std::array<std::vector<double>, n_sums> state;
    mutable NodalVector                             ghosted, ghosted_states;
  };

} // namespace perideal

#endif
