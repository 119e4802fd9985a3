// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_consistent_operator_h
#define perideal_operators_linear_consistent_operator_h

#include <perideal/base/symmetric_pairs.h>
#include <perideal/boundary/cell_expansion.h>
#include <perideal/operators/linear/deformed_cells.h>
#include <perideal/operators/linear/tangent_operator.h>
#include <perideal/operators/weights/consistent_bonds.h>
#include <perideal/operators/weights/gradient_moments.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace perideal
{
  /**
   * Applies the internal force of the consistent form (materials/consistent.h) at small strain, the
   * derivative of
   *
   *     U = sum_i V_i W(eps_i) + 1/2 sum_i (M_i^-1)_km eps(H_ik) : C : eps(H_im) + 1/2 sum_bonds b_ij r_ij^2,
   *     eps_i = sym G_i u,   r_ij = xi.(p_j - p_i) - 1/2 xi.(eps_i + eps_j) xi,
   *
   * with G, H and the values p at the centroids of GradientMoments and M = int (x - x_i) (x) (x - x_i): the
   * mean of the strain in a cell and its linear part store what they do in the material, exactly; a bond what
   * neither explains, which is nothing in quadratic fields.
   *
   * Of laws at finite strain that is the body at rest; linearise() makes it the tangent of ConsistentForce
   * in a deformed state.
   *
   * Symmetric tensors are vectors of pairs (symmetric_pairs.h).
   */
  template <int dim>
  class ConsistentOperator : public TangentOperator<dim>
  {
  public:
    /// @param solid_of by material id; every material of the nodes is listed. Collective.
    ConsistentOperator(const std::shared_ptr<const Families<dim>>        &families,
                       const std::shared_ptr<const GradientMoments<dim>> &moments,
                       const std::shared_ptr<ConsistentBonds<dim>>       &bonds,
                       const SolidOf<dim>                                &solid_of);

    /// From now on internal_force() takes strains as what is above a free expansion of the cells, as it is
    /// then.
    void set_expansion(const std::shared_ptr<const CellExpansion<dim>> &of_cells)
    {
      expansion.of_cells = of_cells;
    }

    /// @param force a ConsistentForce of the same moments and bonds
    void linearise(const BondForce<dim> &force, const Slope slope = Slope::tangent) override;

    void vmult(NodalVector &force, const NodalVector &displacement) const override;
    void internal_force(NodalVector &force, const NodalVector &displacement) const override;
    void add_increments(NodalVector &force) const override;
    /// Blocks near those on the diagonal: of bonds they have what the values at their ends do.
    std::vector<dealii::Tensor<2, dim>> jacobi_blocks() const override;
    void        assemble(const typename BondOperator<dim>::AddBlock &add) const override;
    bool        is_symmetric() const override { return true; }
    std::size_t memory_consumption() const override;

    /// Trace of the mean strain of the last vmult() or internal_force() of the body at rest, by owned node.
    std::vector<double> dilatation() const override;

    double energy_of_expansion() const override { return expansion.energy; }

    /// Forces that the supports exert on the body at the prescribed face values
    /// [N], by entry, after internal_force().
    std::vector<dealii::Tensor<1, dim>> support_forces() const override { return moments->support_forces(); }

  private:
    using Symmetric                       = SymmetricPairs<dim>;
    using Pairs                           = typename Symmetric::Pairs;
    static constexpr unsigned int n_pairs = Symmetric::n_pairs;

    void set_solids(const SolidOf<dim> &solid_of);
    void set_moments();

    void apply(NodalVector                                 &force,
               const NodalVector                           &displacement,
               const typename GradientMoments<dim>::AtFaces at_faces) const;
    void sum_over_bonds() const;
    void turn_into_stress() const;
    /// Takes the stress that a free expansion would make in a cell that is held out of its stress, the mean
    /// times the volume, and out of C times the moments, and adds what it does to the energy.
    void take_expansion(const LocalIndex i, Pairs &stress, Pairs *of_moment) const;

    /// Rows of the gradients, with those of wanted cells of other ranks. Collective.
    GradientRows<dim> make_rows(const std::vector<GlobalIndex> &wanted) const;
    /// Calls visit(j, directions, slot) for the bonds of an owned cell that are this rank's, each once.
    template <typename Visit>
    void visit_bonds_of(const LocalIndex i, const Visit &visit) const;
    /// Calls visit_cell(i, row) for owned cells and visit_bond(b, tension, row of the bond) for the bonds of
    /// this rank, each once.
    template <typename VisitCell, typename VisitBond>
    void
    visit_rows(const GradientRows<dim> &rows, const VisitCell &visit_cell, const VisitBond &visit_bond) const;
    /// Calls visit(block) where block(k, m) are the blocks of the columns of a cell's row.
    template <typename Visit>
    void
    visit_blocks(const LocalIndex i, const typename GradientRows<dim>::Row &row, const Visit &visit) const;

    std::shared_ptr<const Families<dim>>        families;
    std::shared_ptr<const GradientMoments<dim>> moments;
    std::shared_ptr<ConsistentBonds<dim>>       bonds;

    /// C as a matrix on strain pairs [Pa], by number and by owned node of it.
    std::vector<std::array<Pairs, n_pairs>> solids;
    std::vector<dealii::Tensor<4, dim>>     tensors;
    std::vector<LocalIndex>                 solid_of_node;
    struct Expansion
    {
      /// By number: the stress of a free expansion of 1 that is held [Pa], and twice its energy [J/m^3].
      std::vector<Pairs>  stress;
      std::vector<double> work;
      /// Null: cells expand by nothing.
      std::shared_ptr<const CellExpansion<dim>> of_cells = nullptr;
      /// Whether it counts in what is applied now, and its energy_of_expansion().
      bool   counts = false;
      double energy = 0;
    };
    mutable Expansion expansion;
    /// Inverse of int (x - x_i) (x) (x - x_i) [1/m^5], by owned node.
    std::vector<Pairs> inverse_moment;

    /// Once something was linearised.
    std::optional<DeformedCells<dim>> deformed;
    mutable std::vector<double>       dilatations;
  };
} // namespace perideal

#endif
