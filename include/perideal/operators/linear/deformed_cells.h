// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_deformed_cells_h
#define perideal_operators_linear_deformed_cells_h

#include <perideal/operators/force/consistent_force.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <array>
#include <cstdint>
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
   *
   * Where dS/dE is the same at every strain, all else is found from the gradient of the cell and its moment,
   * at all points at once.
   */
  template <int dim>
  class DeformedCells
  {
  public:
    using Row = typename GradientRows<dim>::Row;
    /// What a law has at a point of a cell: F, S [Pa] and dS/dE.
    struct Point
    {
      PointTensor<dim, double> deformation;
      PointPairs<dim, double>  stress;
      PointModulus<dim>        modulus;
    };
    using Points = std::vector<Point>;

    /// The state of the last compute() of the force. Collective.
    DeformedCells(const Families<dim>                               &families,
                  const std::shared_ptr<const GradientMoments<dim>> &moments,
                  const std::shared_ptr<ConsistentBonds<dim>>       &bonds,
                  const ConsistentForce<dim>                        &force);

    /// Sets the states of bonds to the changes read, and sums over the bonds. Collective.
    void sum_over_bonds() const;

    /// Puts the change of what acts on gradients, moments and values in their places.
    void turn_into_stress() const;

    /// The weight of a point of an owned cell times (dP_aL/dF_bN) at each of its points [N m], of which the
    /// blocks of all of its columns are made.
    std::vector<dealii::Tensor<4, dim>> weighted_moduli(const LocalIndex i) const;
    /// The block of two columns of a cell's row.
    /// @param at_points as of weighted_moduli()
    dealii::Tensor<2, dim> block_of(const LocalIndex                           i,
                                    const std::vector<dealii::Tensor<4, dim>> &at_points,
                                    const Row                                 &row,
                                    const std::size_t                          k,
                                    const std::size_t                          m) const;

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

    /// The points of an owned cell as they are.
    Points points_of(const LocalIndex i) const;

    /// Keeps by what the gradients at the points of a cell are above the mean.
    void         keep_changes(const LocalIndex i);
    static Point make_point(const HyperelasticLaw<dim> &law, const dealii::Tensor<2, dim> &gradient);
    /// dP under the change of the gradient at one point, or at some at once.
    template <typename Number>
    static PointTensor<dim, Number> change_of_stress(const PointModulus<dim>        &modulus,
                                                     const PointTensor<dim, Number> &deformation,
                                                     const PointPairs<dim, Number>  &stress,
                                                     const PointTensor<dim, Number> &change);
    static dealii::Tensor<2, dim>   change_of_stress(const Point                  &point,
                                                     const dealii::Tensor<2, dim> &gradient);
    /// The same of all points of a cell, in the places of gradient and moment.
    void turn_into_stress(const LocalIndex i, const PointModulus<dim> &modulus) const;

    std::shared_ptr<const GradientMoments<dim>>  moments;
    std::shared_ptr<ConsistentBonds<dim>>        bonds;
    std::shared_ptr<const CellPoints<dim>>       points;
    typename ConsistentBonds<dim>::Linearisation of_bonds;
    dealii::AlignedVector<NodeRecord>            deformations;
    std::vector<dealii::SymmetricTensor<2, dim>> bond_stress;
    /// By what the gradients at the points of owned nodes' cells are above the mean, by (a, l, axis), in
    /// single precision: what that loses is far below the strain's share of the tangent. Four are read at
    /// once.
    std::vector<std::array<float, dim * dim * dim + 4 - dim>> changes;
    /// Of laws with one modulus, by material; then by owned node its number there, or behind them where its
    /// points stand.
    std::vector<PointModulus<dim>> moduli;
    std::vector<std::uint32_t>     modulus_of;
    std::vector<Points>            of_other_laws;
  };
} // namespace perideal

#endif
