// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_quadrature_moving_least_squares_h
#define perideal_quadrature_moving_least_squares_h

#include <perideal/base/least_squares.h>

#include <deal.II/base/point.h>

#include <string>
#include <vector>

namespace perideal
{
  /**
   * Fits moving least squares of order two (QUAD 3.3.2): finds the weights phi_k with which values at
   * scattered points give the value at x of the quadratic fit about x,
   *
   *     v(x) = sum_k phi_k(x) v_k,    phi_k = W(d_k) p(x_k).A^-1 p(x),    A = sum_k W(d_k) p(x_k) p(x_k)^T,
   *
   * with the quartic spline W(d) = 1 - 6 d^2 + 8 d^3 - 3 d^4 of d = |x - x_k|/r (3.24), r the radius of the
   * support. The basis p is that of the monomials in (x_k - x)/r, so that the condition of A does not depend
   * on where the body lies or on the unit of length.
   */
  template <int dim>
  class MovingLeastSquares
  {
  public:
    /// Terms of the basis (3.20): as many points must lie in general position.
    static constexpr unsigned int n_terms = (dim + 1) * (dim + 2) / 2;
    /// Largest condition of A in the row sum norm (3.39), (3.40).
    static constexpr double largest_condition = 1e8;
    /// Largest error of the reproducing conditions (3.42)-(3.44), of lengths in radii.
    static constexpr double consistency_tolerance = 1e-8;

    MovingLeastSquares();

    /// Fits about @p x to the points within @p radius [m]. False when they make no quadratic fit;
    /// problem() says why.
    bool
    reinit(const dealii::Point<dim> &x, const std::vector<dealii::Point<dim>> &points, const double radius);

    /// phi_k, by points of reinit(); 0 beyond the radius.
    const std::vector<double> &weights() const { return phi; }

    /// Why the last fit failed; empty when it did not.
    const std::string &problem() const { return reason; }

  private:
    /// The monomials of (point - x)/radius.
    static void evaluate_basis(const dealii::Tensor<1, dim> &distance, std::vector<double> &basis);
    /// Returns the largest error of the reproducing conditions.
    double consistency_error() const;

    MomentMatrix           moments;
    dealii::Vector<double> solution;
    /// Those within the radius: their numbers, weights W, and basis, n_terms a point.
    std::vector<unsigned int> member;
    std::vector<double>       weight, basis_of_member;
    std::vector<double>       phi, basis;
    std::string               reason;
  };
} // namespace perideal

#endif
