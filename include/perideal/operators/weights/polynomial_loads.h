// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_weights_polynomial_loads_h
#define perideal_operators_weights_polynomial_loads_h

#include <perideal/reconstruction/cell_polynomials.h>
#include <perideal/reconstruction/monomials.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <map>

namespace perideal
{
  /// Sums forces at points of owned cells as those on the coefficients of their polynomials
  /// (CellPolynomials), by the cells that bear any.
  template <int dim>
  class PolynomialLoads
  {
  public:
    /// Forces on the coefficients [N], [N m], [N m^2], the value at the centroid first.
    using OfCell = std::array<dealii::Tensor<1, dim>, Monomials<dim>::n_coefficients>;

    explicit PolynomialLoads(const CellPolynomials<dim> &polynomials)
      : polynomials(polynomials)
    {
    }

    /// Adds a force [N] at a point of a cell.
    void add(const LocalIndex cell, const dealii::Point<dim> &point, const dealii::Tensor<1, dim> &force)
    {
      std::array<double, Monomials<dim>::n> monomial;
      Monomials<dim>::evaluate(point - polynomials.centroids()[cell], monomial);
      OfCell &acting = cells[cell];
      for (unsigned int m = 0; m < acting.size(); ++m)
        acting[m] += monomial[m] * force;
    }

    const std::map<LocalIndex, OfCell> &by_cell() const { return cells; }

  private:
    const CellPolynomials<dim>  &polynomials;
    std::map<LocalIndex, OfCell> cells;
  };
} // namespace perideal

#endif
