// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_bond_operator_h
#define perideal_operators_linear_bond_operator_h

#include <perideal/base/types.h>
#include <perideal/operators/weights/add_block.h>
#include <perideal/operators/weights/family_weights.h>

#include <deal.II/base/tensor.h>

#include <functional>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Applies the linear internal force of a bond model, K u, over all nodes of this rank
   * (fictitious ones included), matrix-free. Boundary conditions are
   * ConstrainedOperator's.
   */
  template <int dim>
  class BondOperator
  {
  public:
    virtual ~BondOperator() = default;

    /// force = K displacement, [N] from [m]; the force the bonds resist with,
    /// so that K u = external force. Both vectors have owned nodes, dim values each. Collective.
    virtual void vmult(NodalVector &force, const NodalVector &displacement) const = 0;

    /// The same with what boundary values that the operator itself carries add to K u.
    virtual void internal_force(NodalVector &force, const NodalVector &displacement) const
    {
      vmult(force, displacement);
    }

    /// Forces that supports exert on the body at such boundary values [N], by entry of FaceValues, after
    /// internal_force(); none where the operator carries none.
    virtual std::vector<dealii::Tensor<1, dim>> support_forces() const { return {}; }

    /// What a free expansion of the cells adds to half the work of the forces of the last internal_force(),
    /// so that it becomes the energy stored, on this rank [J].
    virtual double energy_of_expansion() const { return 0.; }

    /// The dim x dim blocks on the diagonal of K, or what preconditions as well, by owned node [N/m].
    /// Collective.
    virtual std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const = 0;

    using AddBlock = perideal::AddBlock;

    /// Hands out K piece by piece, in nodes' dim*number + component. Pieces
    /// overlap and may lie in other ranks' rows; their sum is K.
    virtual void assemble(const AddBlock &add) const = 0;

    /// Receives a bond's nodes (the first owned) and the force it puts on the first [N].
    using VisitBond = std::function<void(const LocalIndex, const LocalIndex, const dealii::Tensor<1, dim> &)>;

    /// Shows the bond forces of the last vmult(); a bond that the partition cuts
    /// is shown on both ranks, from either end.
    /// Only for models whose forces are all bond forces.
    virtual void visit_bond_forces(const VisitBond &) const
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    /// Dilatation of the last vmult(), by owned node.
    virtual std::vector<double> dilatation() const = 0;

    virtual bool is_symmetric() const = 0;

    /// Number of families of all ranks whose weights do not meet the model's conditions.
    FamilyCounts counts;
    /// What became of each owned family.
    std::vector<FamilyReport> reports;

    virtual std::size_t memory_consumption() const = 0;

    /// A vector over owned nodes.
    void initialize(NodalVector &vector) const { vector.reinit(partitioner); }

  protected:
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
  };

  /// Creates the linear operator of weighed bonds.
  template <int dim>
  std::unique_ptr<BondOperator<dim>>
  create_bond_operator(const std::shared_ptr<const BondWeights<dim>> &weights);

  /// Weighs every family with the model and chooses the loop for its shape. Collective.
  /// @param solid_of by material id; every material of the nodes is listed.
  template <int dim>
  std::unique_ptr<BondOperator<dim>>
  create_bond_operator(const std::shared_ptr<const Families<dim>> &families,
                       LinearModel<dim>                           &model,
                       const SolidOf<dim>                         &solid_of);
} // namespace perideal

#endif
