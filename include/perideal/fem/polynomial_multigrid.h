// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_fem_polynomial_multigrid_h
#define perideal_fem_polynomial_multigrid_h

#include <perideal/base/types.h>
#include <perideal/fem/elastic_fem.h>

#include <memory>

namespace perideal
{
  /**
   * Preconditions quadratic elements by Chebyshev smoothing on their matrix
   * and, between, one cycle of algebraic multigrid on the matrix of linear
   * elements on the same cells. Multigrid on the quadratic matrix itself is slower
   * and needs its memory twice.
   */
  template <int dim>
  class PolynomialMultigrid
  {
  public:
    /// @param quadratic an assembled problem, which must outlive this object
    /// @param linear the same with linear elements on the same triangulation, assembled
    PolynomialMultigrid(const ElasticFem<dim> &quadratic, std::unique_ptr<const ElasticFem<dim>> linear);
    ~PolynomialMultigrid();

    /// Approximates the inverse of the quadratic matrix applied to @p source.
    void vmult(NodalVector &destination, const NodalVector &source) const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation;
  };
} // namespace perideal

#endif
