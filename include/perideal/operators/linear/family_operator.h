// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_family_operator_h
#define perideal_operators_linear_family_operator_h

#include <perideal/base/lanes.h>
#include <perideal/operators/linear/bond_operator.h>
#include <perideal/operators/linear/tangent_operator.h>
#include <perideal/operators/weights/family_weights.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <functional>
#include <memory>
#include <type_traits>
#include <vector>

namespace perideal
{
  /// Of FamilyOperator at rest: nothing.
  struct BondsAtRest
  {
  };

  /// Of FamilyOperator in the deformed body, by slot: |xi|/|y_j - y_i|, zero of bonds that carry nothing;
  /// k' and g as TangentOperator has them [N/m^3], [N/m]; what takes the place of the scale in the sums of
  /// families where bonds go on to soften, else empty.
  struct DeformedBonds
  {
    std::vector<double> scale, stiffness, tension, scale_in_sums;

    const std::vector<double> &of_sums() const { return scale_in_sums.empty() ? scale : scale_in_sums; }
  };

  /**
   * Applies the linear internal force of models of one family shape. The vector of a bond is recomputed from
   * the positions, which is faster than loading it.
   *
   * The same loops make the tangent in the deformed body: the vector there is p = scale (y_j - y_i) for xi,
   * the stiffness k', and g adds to the force.
   */
  template <int dim, unsigned int n_sums, bool own_force_weights, bool deformed = false>
  class FamilyOperator : public std::conditional_t<deformed, TangentOperator<dim>, BondOperator<dim>>
  {
  public:
    explicit FamilyOperator(
      const std::shared_ptr<const FamilyWeights<dim, n_sums, own_force_weights>> &weights);

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
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

  protected:
    /// The vector of the bond between two local nodes, deformed or not.
    dealii::Tensor<1, dim> bond_vector(const LocalIndex i, const LocalIndex j, const BondIndex slot) const
    {
      if constexpr (!deformed)
        return families->position[j] - families->position[i];
      else
        return deformation.scale[slot] * present_bond(i, j);
    }
    /// That along which displacements count in the sums of families.
    dealii::Tensor<1, dim> vector_in_sums(const LocalIndex i, const LocalIndex j, const BondIndex slot) const
    {
      if constexpr (!deformed)
        return bond_vector(i, j, slot);
      else
        return deformation.of_sums()[slot] * present_bond(i, j);
    }

    std::shared_ptr<const FamilyWeights<dim, n_sums, own_force_weights>> weights;
    std::shared_ptr<const Families<dim>>                                 families;
    /// Where the nodes are.
    dealii::AlignedVector<NodeRecord>                        positions;
    std::conditional_t<deformed, DeformedBonds, BondsAtRest> deformation;
    /// Where weights stand by kind of bond, a record of each: near and far weight of the first sum, then the
    /// same of the second or of forces, or the stiffness.
    dealii::AlignedVector<NodeRecord> kinds;

  private:
    dealii::Tensor<1, dim> present_bond(const LocalIndex i, const LocalIndex j) const
    {
      dealii::Tensor<1, dim> result;
      for (int d = 0; d < dim; ++d)
        result[d] = positions[j].value[d] - positions[i].value[d];
      return result;
    }

    void make_kinds();

    void import_displacement(const NodalVector &displacement) const;
    /// @p shared: whether weights stand by kind of bond.
    template <bool shared>
    void sum_over_families() const;
    void turn_sums_into_states() const;
    template <bool shared>
    void sum_forces() const;
    template <bool shared>
    void apply(const NodalVector &displacement) const;

    /// Of four bonds: the weights of their ends, and their stiffness.
    struct FourBonds
    {
      Lanes near[n_sums > 0 ? n_sums : 1], far[n_sums > 0 ? n_sums : 1], stiffness;
    };
    /// Those for sums, without a stiffness, or for forces, of the bonds from slot @p k on.
    template <bool shared, bool for_forces>
    void load_weights(FourBonds &bonds, const BondIndex k) const;

    /// What multiplies the bond's own extension in its force.
    double stiffness(const BondIndex slot) const
    {
      if constexpr (deformed)
        return deformation.stiffness[slot];
      else
        return weights->stiffness[weights->at(slot)];
    }

    // Work space of vmult().
    mutable dealii::AlignedVector<NodeRecord>       displacements, forces;
    mutable std::array<std::vector<double>, n_sums> sums;
    mutable std::array<std::vector<double>, n_sums> state;
    mutable NodalVector                             ghosted, ghosted_states;
  };

} // namespace perideal

#endif
