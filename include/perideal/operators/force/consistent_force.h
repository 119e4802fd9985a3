// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_force_consistent_force_h
#define perideal_operators_force_consistent_force_h

#include <perideal/operators/force/breaking_bonds.h>
#include <perideal/operators/force/continuum_force.h>
#include <perideal/operators/force/levelled_force.h>
#include <perideal/operators/weights/cell_points.h>
#include <perideal/operators/weights/consistent_bonds.h>
#include <perideal/operators/weights/gradient_moments.h>
#include <perideal/operators/weights/laws_of_nodes.h>

#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Computes the force of the consistent form (materials/consistent.h) at finite strain, - dU/du of
   *
   *     U = sum_i V_i/(2 dim) sum_p W(I + G_p) + 1/2 sum_bonds b_ij r_ij^2,
   *
   * with the law W at the points of each cell (CellPoints) and bonds between the values at the centroids
   * (ConsistentBonds). Uniform deformations leave the bonds at rest, rotations the whole. Of laws that are
   * linear, strains are small, and the force is that of ConsistentOperator.
   *
   * Nothing breaks: cracks are where faces and bonds were opened for them from the beginning.
   */
  template <int dim>
  class ConsistentForce : public BreakingBonds<dim>, public ContinuumForce<dim>, public LevelledForce
  {
  public:
    /// @param laws by material id; every material of the nodes is listed
    ConsistentForce(const std::shared_ptr<const Families<dim>>        &families,
                    const std::shared_ptr<const GradientMoments<dim>> &moments,
                    const std::shared_ptr<ConsistentBonds<dim>>       &bonds,
                    const LawsByMaterial<dim>                         &laws);

    /// Not for this form: nothing breaks.
    void reweigh_as_bonds_break(const std::shared_ptr<const BondWeights<dim>> &,
                                const typename BondForce<dim>::Reweigh &) override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }
    /// Not for this form: forces are not those of bonds.
    void visit_bond_forces(const typename BondForce<dim>::VisitBond &) const override
    {
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    void compute(NodalVector &force, const NodalVector &displacement) override;

    /// By CellSteps. Parts leave support_forces() as they are.
    void compute_parts(std::vector<LevelledForce::Part> &parts,
                       const NodalVector                &displacement,
                       const unsigned int                highest) override;

    double              strain_energy() const override;
    double              released_energy(const NodalVector &, const double) const override { return 0.; }
    std::vector<double> dilatation() const override;
    std::vector<dealii::Tensor<1, dim>> support_forces() const override { return support; }
    std::size_t                         memory_consumption() const override;

    std::vector<dealii::Tensor<2, dim>> gradients() const override;
    ExpandedLaw<dim>                    law(const LocalIndex i) const override { return laws.mean(i); }

    /// Brings gradients, moments and bonds to the last compute() again; others may have used them since.
    /// Collective.
    /// @param some only of these; null: of all cells
    void evaluate(const CellSubset *some = nullptr) const;

    /// Whether laws are linear and strains small.
    bool is_linear() const { return has_small_strain; }

    const std::shared_ptr<const CellPoints<dim>> &cell_points() const { return points; }
    const LawsOfNodes<dim>                       &laws_of_nodes() const { return laws; }

    /// From now on cells expand freely by what they have then.
    /// @param laws_in_space of materials in plane strain
    void expand(const LawsByMaterial<3>                         &laws_in_space,
                const std::shared_ptr<const CellExpansion<dim>> &of_cells)
    {
      laws.expand(*families, laws_in_space, of_cells);
    }

    /// Scales the energy of cells and of the bonds that stabilise them from now on, here and in operators
    /// that share these.
    /// @param of_nodes by local node
    void set_shares(const std::vector<double> &of_nodes) { bonds->set_shares(of_nodes); }
    /// The same, and adds to the force of the last compute() [N] what that changes of it. Collective.
    /// @return what is stored more then [J], on all ranks
    double change_shares(const std::vector<double> &of_nodes, NodalVector &force);

    /// The strain of an owned node at the last compute() [-]: Green's, of linear laws the small one.
    dealii::SymmetricTensor<2, dim> strain(const LocalIndex i) const { return bonds->strain(i); }

  private:
    using BreakingBonds<dim>::families;

    bool carries_force(const BondIndex slot) const override { return bonds->stiffness(slot) > 0; }
    void clear_weights(const BondIndex slot) override { bonds->remove(slot); }

    /// Puts the stress of a cell, and what its bonds do besides, in the places of gradient and moment.
    /// @param counts whether its own stress does
    void turn_into_stress(const LocalIndex i, const bool counts) const;
    /// Leaves in added what evaluate() has found, the force turned round.
    void spread(const CellSubset *some);
    /// The energy of what evaluate() has found [J].
    double evaluated_energy() const;

    std::shared_ptr<const GradientMoments<dim>> moments;
    std::shared_ptr<ConsistentBonds<dim>>       bonds;
    std::shared_ptr<const CellPoints<dim>>      points;
    LawsOfNodes<dim>                            laws;
    bool                                        has_small_strain;
    NodalVector                                 last, added;
    std::vector<dealii::Tensor<1, dim>>         support;
  };
} // namespace perideal

#endif
