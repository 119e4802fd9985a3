// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_polynomial_closure_h
#define perideal_reconstruction_polynomial_closure_h

#include <perideal/base/lanes.h>
#include <perideal/base/types.h>
#include <perideal/reconstruction/monomials.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <vector>

namespace perideal
{
  /**
   * Gives displacements of cells the quadratics that the means around do not determine
   * (QuadraticFit::undetermined()), such as the curvature across a body two cells thick: those that leave the
   * material unstrained were they alone. With none, a strip of two layers would bend in plane strain across
   * it, 1/(1-nu^2) too stiff.
   *
   * With the polynomials w_j that are not determined, the fitted displacement p becomes p + sum_j z_j w_j
   * such that
   *
   *     sum_kl M_kl d_k eps(v) : C : d_l eps(p + sum_j z_j w_j) = 0,   M = mean of (x - x_i) (x) (x - x_i),
   *
   * for all v = a ((x - x_i).n)^2: tractions do not vary from one surface to the other, n being the normals
   * of these (QuadraticFit::squares_across()). Where the w_j are these squares, this is the least energy of
   * the strain's linear part, int eps : C : eps - V mean(eps) : C : mean(eps). On distorted meshes the
   * polynomials that are not determined have a share of determined ones, and the least energy would make
   * those too soft. Bending is exact in both.
   *
   * The z_j depend linearly on the quadratics that were fitted, and couple the components.
   */
  template <int dim>
  class PolynomialClosure
  {
  public:
    static constexpr unsigned int n_terms     = Monomials<dim>::n_terms;
    static constexpr unsigned int n_quadratic = Monomials<dim>::n_quadratic;
    using Terms                               = std::array<double, n_terms>;

    /// A polynomial w, coefficients of its monomials, and how much of it a displacement has: component a of z
    /// is the sum of answer[dim p + b].value[a] times coefficient p of component b over the quadratic
    /// monomials.
    struct Direction
    {
      Terms                                     polynomial;
      std::array<NodeRecord, dim * n_quadratic> answer;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        for (double &term : polynomial)
          archive &term;
        for (NodeRecord &record : answer)
          archive &record.value;
      }
    };

    /// Adds a cell, behind those that there are.
    /// @param undetermined polynomials w
    /// @param across as many squares v
    /// @param second_moment M [m^2]
    void add(const LocalIndex                       cell,
             const std::vector<Terms>              &undetermined,
             const std::vector<Terms>              &across,
             const dealii::SymmetricTensor<2, dim> &second_moment,
             const dealii::SymmetricTensor<4, dim> &stiffness);

    /// Cells whose polynomials are closed.
    const std::vector<LocalIndex> &cells() const { return closed; }

    /// What a cell has: nothing where its polynomial was complete.
    dealii::ArrayView<const Direction> directions(const LocalIndex cell) const;

    /// Closes the polynomial of the n-th cell: coefficients without the constant, lanes by component.
    void close(const std::size_t n, Lanes *terms) const;
    /// The transpose: adds what acts on the coefficients of the closed polynomial besides to what acts on
    /// those of the fitted one.
    void add_transposed(const std::size_t n, Lanes *acting) const;

    std::size_t memory_consumption() const;

  private:
    std::vector<LocalIndex>  closed;
    std::vector<std::size_t> first = {0};
    std::vector<Direction>   all;
  };
} // namespace perideal

#endif
