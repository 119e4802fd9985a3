// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_bond_blocks_h
#define perideal_operators_linear_bond_blocks_h

#include <perideal/base/symmetric_pairs.h>
#include <perideal/operators/weights/gradient_rows.h>

#include <array>
#include <vector>

namespace perideal
{
  /// A bond, where it pulls its ends, and where it feels the gradients there [m]: xi, y, F_i xi and F_j xi.
  template <int dim>
  struct BondDirections
  {
    dealii::Tensor<1, dim> bond, pull, near, far;

    bool are_at_rest() const { return pull == bond && near == bond && far == bond; }
  };

  /**
   * Adds up what the bonds of the consistent form give to the diagonal blocks of its matrix,
   *
   *     b rho rho^T + b r (p_j - p_i)^2 I,
   *     rho_a = (p_j - p_i) y_a - 1/2 [ (F_i xi)_a xi.G_i + (F_j xi)_a xi.G_j ],
   *
   * p and G rows of the cells at both ends, G that of component a of the displacement.
   *
   * Bonds are taken cell by cell, so that the columns of its row are looked up once.
   */
  template <int dim>
  class BondBlocks
  {
  public:
    /// What bonds read of the row of a cell, in arrays that loops run through.
    class Ends
    {
    public:
      explicit Ends(const typename GradientRows<dim>::Row &row);

      std::size_t size() const { return column.size(); }
      /// Whether G is that of all components of the displacement.
      bool is_alike() const { return numbers.size() == (1 + dim) * size(); }

      /// Writes pull p - 1/2 end xi.G by column, G that of a component.
      void fill(const double                  pull,
                const double                  end,
                const dealii::Tensor<1, dim> &bond,
                const unsigned int            component,
                std::vector<double>          &result) const;

      std::vector<LocalIndex> column;

    private:
      std::array<unsigned int, dim> pattern;
      /// p, and of each pattern G by direction.
      std::vector<double> numbers;
    };

    /// @param blocks by column of the rows
    explicit BondBlocks(std::vector<dealii::Tensor<2, dim>> &blocks);

    /// Takes the cell whose bonds follow; it must stay until finish().
    void start(const Ends &cell);
    /// @param stiffness b [N/m^3]
    /// @param tension b r [N/m]
    void
    add(const BondDirections<dim> &directions, const double stiffness, const double tension, const Ends &far);
    void finish();

  private:
    using Symmetric = SymmetricPairs<dim>;

    /// Fills of_bond and of_far, and returns how many rows they have.
    unsigned int fill(const BondDirections<dim> &directions, const bool has_tension, const Ends &far);
    void         add_at(const LocalIndex column, const typename Symmetric::Pairs &block);

    static constexpr LocalIndex          nowhere = static_cast<LocalIndex>(-1);
    std::vector<dealii::Tensor<2, dim>> &blocks;
    const Ends                          *near = nullptr;
    /// Where a column stands in the row of the cell.
    std::vector<LocalIndex> place;
    /// In the columns of the cell, and what the far end gives: rho by component and, where the bond is in
    /// tension, p_j - p_i; of bodies at rest, whose rho is parallel to xi, one number.
    std::array<std::vector<double>, dim + 1> of_bond, of_far;
    /// By pair of axes, in the columns of the cell.
    std::array<std::vector<double>, Symmetric::n_pairs> sums;
  };
} // namespace perideal

#endif
