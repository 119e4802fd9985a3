// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_cell_polynomials_h
#define perideal_reconstruction_cell_polynomials_h

#include <perideal/geometry/bond_predicate.h>
#include <perideal/nodes/cell_graph.h>
#include <perideal/reconstruction/polynomial_closure.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <functional>
#include <vector>

namespace perideal
{
  /// What the unknown of a cell is: the mean of a field over it, or the value at its centroid.
  enum class CellUnknown
  {
    mean,
    value
  };

  /**
   * Fits a quadratic polynomial to the means of a field over each cell and the cells around it,
   *
   *     p_i(x) = u_i + sum_t c_t (m_t(x - x_i) - mean of m_t over cell i),
   *
   * of which the mean over its own cell is the cell's. Coefficients are sums over the stencil,
   *
   *     c_t = sum_k R_kt (u_k - u_i),
   *
   * of weighted least squares with the means of the monomials over each cell: exact for quadratic fields on
   * any mesh. Or it fits values at the centroids, in the same way without means of m_t: so in motion, where
   * the kinetic energy of a plane wave is that of masses with these values up to fourth order, of masses with
   * the means up to second; weights are nearly even then, but less for cells smaller than that in the middle,
   * which bounds the largest eigenvalue.
   *
   * The stencil has the cells of the same material that share a vertex with the cell, and where a face lies
   * at the boundary or at another material, those around the cell behind it. Where they do not determine all
   * quadratics it takes one ring more; what no ring determines is left out: linear terms are fitted first,
   * quadratics to what these leave. closure() says what a displacement has in its place.
   *
   * A crack ends the body as its boundary does: no stencil reaches across.
   *
   * Cells whose stencils are equal but for rounding share their coefficients.
   *
   * Nodes are numbered as in the cell graph.
   */
  template <int dim>
  class CellPolynomials
  {
  public:
    static constexpr unsigned int n_terms = Monomials<dim>::n_terms;
    using Terms                           = std::array<double, n_terms>;
    /// Stiffness of a material [Pa].
    using Stiffness = std::function<dealii::SymmetricTensor<4, dim>(dealii::types::material_id)>;

    /// Collective.
    /// @param stiffness of displacements whose polynomials are closed, which needs means; without it, none is
    /// @param is_cut whether a crack separates the cells of two nodes; empty: none does
    /// @param share_equal whether equal stencils are looked for
    CellPolynomials(const Mesh<dim>          &mesh,
                    const Nodes<dim>         &nodes,
                    const Stiffness          &stiffness   = {},
                    const BondPredicate<dim> &is_cut      = {},
                    const CellUnknown         unknown     = CellUnknown::mean,
                    const bool                share_equal = true);

    const CellGraph<dim> &graph() const { return cells; }

    /// Mean of (x - x_i) (x) (x - x_i) over the cell [m^2] and its centroid x_i, by local node.
    const std::vector<dealii::SymmetricTensor<2, dim>> &second_moments() const { return moments; }
    const std::vector<dealii::Point<dim>>              &centroids() const { return centroid; }
    /// Volumes of owned cells [m^3].
    const std::vector<double> &volumes() const { return volume; }

    /// Columns of R of owned cells: those of cell i are [first[i], first[i+1]), the cell itself left out.
    const std::vector<BondIndex>  &first() const { return row; }
    const std::vector<LocalIndex> &columns() const { return column; }
    /// R of an owned cell, in the order of its columns.
    const Terms *coefficients(const LocalIndex i) const { return coefficient.data() + row_of[i]; }
    /// The same number for owned cells whose coefficients are the same.
    std::size_t kind_of(const LocalIndex i) const { return row_of[i]; }
    /// Columns of this rank whose coefficients are those of another cell.
    std::size_t n_shared() const { return column.size() - coefficient.size(); }

    /// Calls visit(node, weight) for what the value of an owned cell's polynomial at a point takes of means.
    template <typename Visit>
    void visit_value(const LocalIndex i, const dealii::Point<dim> &point, const Visit &visit) const
    {
      std::array<double, Monomials<dim>::n> monomial;
      Monomials<dim>::evaluate(point - centroid[i], monomial);
      const auto   of_unknown = at_unknown(i);
      const Terms *of_column  = coefficients(i);
      double       own        = 1.;
      for (BondIndex k = row[i]; k < row[i + 1]; ++k, ++of_column)
        {
          double weight = 0;
          for (unsigned int t = 0; t < n_terms; ++t)
            weight += (*of_column)[t] * (monomial[1 + t] - (t < dim ? 0. : of_unknown[t - dim]));
          own -= weight;
          visit(column[k], weight);
        }
      visit(i, own);
    }

    /// Means of the quadratic monomials over an owned cell, in the order of the pairs [m^2].
    std::array<double, Monomials<dim>::n_quadratic> means(const LocalIndex i) const
    {
      std::array<double, Monomials<dim>::n_quadratic> result;
      for (unsigned int p = 0; p < result.size(); ++p)
        result[p] = moments[i][SymmetricPairs<dim>::axes(p).first][SymmetricPairs<dim>::axes(p).second];
      return result;
    }

    /// What the unknown of a cell is of the quadratic monomials: their means, or zero at the centroid [m^2].
    std::array<double, Monomials<dim>::n_quadratic> at_unknown(const LocalIndex i) const
    {
      return unknown == CellUnknown::mean ? means(i) : std::array<double, Monomials<dim>::n_quadratic>{};
    }

    /// Owned cells whose stencil lies in a plane (a body one cell thick), where linear fields are not exact.
    const std::vector<bool> &deficient() const { return is_deficient; }

    /// Owned cells whose stencil does not determine all quadratics, those included.
    LocalIndex n_incomplete() const { return n_incomplete_cells; }

    /// What the polynomials of a displacement have besides.
    const PolynomialClosure<dim> &closure() const { return closures; }

    std::size_t memory_consumption() const;

  private:
    class Builder;

    CellGraph<dim>                               cells;
    CellUnknown                                  unknown;
    std::vector<dealii::SymmetricTensor<2, dim>> moments;
    std::vector<dealii::Point<dim>>              centroid;
    std::vector<double>                          volume;
    std::vector<BondIndex>                       row = {0};
    std::vector<LocalIndex>                      column;
    /// Coefficients of different stencils, and where those of each cell begin.
    std::vector<Terms>     coefficient;
    std::vector<BondIndex> row_of;
    std::vector<bool>      is_deficient;
    LocalIndex             n_incomplete_cells = 0;
    PolynomialClosure<dim> closures;
  };
} // namespace perideal

#endif
