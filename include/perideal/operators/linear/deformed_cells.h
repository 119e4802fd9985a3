// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_deformed_cells_h
#define perideal_operators_linear_deformed_cells_h

#include <perideal/operators/force/consistent_force.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <array>
#include <memory>
#include <vector>

namespace perideal
{
  /**
   * Computes how the forces of cells change about a deformed state of the consistent form: the second
   * derivatives of the energy of ConsistentForce. With dP/dF at the points of a cell, its gradient F = I + G,
   * and S the derivative of the bonds' energy with respect to its Green's strain,
   *
   *     dE = sym(F^T dG),   d(dU/dG) = sum_p V_p dP_p + F dS + dG S.
   *
   * Of the law it keeps dS/dE, and not dP/dF, of which two thirds are geometry:
   *
   *     dP_p = F_p (dS/dE : sym(F_p^T dF_p)) + dF_p S_p.
   */
  template <int dim>
  class DeformedCells
  {
  public:
    using Row = typename GradientRows<dim>::Row;

    /// The state of the last compute() of the force. Collective.
    DeformedCells(const Families<dim>                               &families,
                  const std::shared_ptr<const GradientMoments<dim>> &moments,
                  const std::shared_ptr<ConsistentBonds<dim>>       &bonds,
                  const ConsistentForce<dim>                        &force);

    /// Sets the states of bonds to the changes read, and sums over the bonds. Collective.
    void sum_over_bonds() const;

    /// Puts the change of what acts on gradients, moments and values in their places.
    void turn_into_stress() const;

    /// The block of two columns of a cell's row.
    dealii::Tensor<2, dim>
    block_of(const LocalIndex i, const Row &row, const std::size_t k, const std::size_t m) const;

    /// The bond of an owned node with another local one in the deformed body [m].
    dealii::Tensor<1, dim> bond(const LocalIndex i, const LocalIndex j) const;
    /// F of a local node.
    dealii::Tensor<2, dim> deformation(const LocalIndex i) const
    {
      return to_tensor<dim>(deformations.data() + dim * i);
    }
    /// b_ij r_ij of a bond [N/m].
    double tension(const BondIndex slot) const { return of_bonds.tension[slot]; }

    std::size_t memory_consumption() const;

  private:
    using Symmetric = SymmetricPairs<dim>;
    using Pairs     = typename Symmetric::Pairs;
    /// dS/dE as a symmetric matrix on strain pairs, its lower triangle by rows [Pa].
    using Modulus = std::array<double, Symmetric::n_pairs *(Symmetric::n_pairs + 1) / 2>;
    /// F - I, row by row, and S [Pa] at a point of a cell, in single precision: what that loses is far below
    /// the strain's share of the tangent.
    struct Point
    {
      std::array<float, dim * dim>          gradient;
      std::array<float, Symmetric::n_pairs> stress;
    };

    /// The modulus of a law at a point.
    static Modulus pack(const HyperelasticLaw<dim> &law, const dealii::Tensor<2, dim> &gradient);
    static Modulus pack(const dealii::SymmetricTensor<4, dim> &modulus);
    /// dP at a point of a cell under the change of the gradient there.
    dealii::Tensor<2, dim>
    change_of_stress(const LocalIndex i, const unsigned int p, const dealii::Tensor<2, dim> &gradient) const;

    std::shared_ptr<const GradientMoments<dim>>        moments;
    std::shared_ptr<ConsistentBonds<dim>>              bonds;
    std::shared_ptr<const CellPoints<dim>>             points;
    typename ConsistentBonds<dim>::Linearisation       of_bonds;
    dealii::AlignedVector<NodeRecord>                  deformations;
    std::vector<dealii::SymmetricTensor<2, dim>>       bond_stress;
    std::vector<std::array<Point, CellPoints<dim>::n>> states;
    /// The moduli that are the same at all points of a material's cells, then those of the points of others.
    std::vector<Modulus> moduli;
    std::size_t          n_constant = 0;
    /// By owned node, that of the first point.
    std::vector<std::size_t> modulus_of;
  };
} // namespace perideal

#endif
