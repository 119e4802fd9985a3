// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_system_constrained_operator_h
#define perideal_operators_system_constrained_operator_h

#include <perideal/boundary/mirror_layer.h>
#include <perideal/operators/linear/bond_operator.h>

#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Represents the linear system of a static scene over the displacements of the real
   * nodes: the bond operator with fictitious nodes eliminated and with held
   * components taken out (their rows and columns are those of the identity). Springs may anchor unknowns
   * that nothing else holds.
   */
  template <int dim>
  class ConstrainedOperator
  {
  public:
    /// @param nodes those whose displacements are the unknowns, the real ones of the mirror
    /// @param held by dim*node + component, 1 where the displacement is prescribed
    ConstrainedOperator(const std::shared_ptr<const BondOperator<dim>> &bonds,
                        const std::shared_ptr<const MirrorLayer<dim>>  &mirror,
                        const NodeCloud<dim>                           &nodes,
                        const std::vector<std::uint8_t>                &held);

    /// Springs between free components and where they are, by dim*node + component [N/m]; empty: none.
    void                       set_anchors(const std::vector<double> &stiffness) { anchors = stiffness; }
    const std::vector<double> &anchor_stiffness() const { return anchors; }

    /// The homogeneous part, for linear solvers.
    void vmult(NodalVector &destination, const NodalVector &source) const;

    /// Internal force K u of all nodes, fictitious ones included, with the
    /// prescribed values of the mirror [N].
    void internal_force(NodalVector &force_on_all, const NodalVector &displacement) const;

    /// Right-hand side for the correction to @p displacement, whose held
    /// components have their values: external minus internal force, 0 where held.
    void
    residual(NodalVector &result, const NodalVector &external_force, const NodalVector &displacement) const;

    /// dim x dim blocks of the diagonal; of held rows and columns only the diagonal is left.
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const;

    bool is_symmetric() const { return bonds->is_symmetric() && mirror->keeps_symmetry(); }
    bool is_held(const std::size_t component) const { return held[component] != 0; }

    /// Vectors over real nodes and over all nodes.
    void initialize(NodalVector &vector) const { vector.reinit(partitioner); }
    void initialize_all(NodalVector &vector) const { bonds->initialize(vector); }

    LocalIndex               n_nodes() const { return mirror->n_real(); }
    GlobalIndex              first_global() const { return first_global_node; }
    GlobalIndex              n_global() const { return n_global_nodes; }
    MPI_Comm                 communicator() const { return mirror->nodes().communicator; }
    const BondOperator<dim> &bond_operator() const { return *bonds; }
    const MirrorLayer<dim>  &mirror_layer() const { return *mirror; }

  private:
    std::shared_ptr<const BondOperator<dim>>                   bonds;
    std::shared_ptr<const MirrorLayer<dim>>                    mirror;
    std::vector<std::uint8_t>                                  held;
    std::vector<double>                                        anchors;
    GlobalIndex                                                first_global_node, n_global_nodes;
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    mutable NodalVector                                        masked, extended, force;
  };
} // namespace perideal

#endif
