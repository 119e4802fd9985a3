// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_quadratic_fit_h
#define perideal_reconstruction_quadratic_fit_h

#include <perideal/reconstruction/monomials.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <Eigen/Dense>

#include <array>
#include <vector>

namespace perideal
{
  /**
   * Fits quadratics to the means of cells around one of them, whose mean they keep (CellPolynomials).
   *
   * Distances are measured with the inverse covariance of the stencil, so that stretched and sheared cells
   * weigh as their undeformed images would; weights are exp(-|y|^2/2). Linear terms are fitted first and
   * quadratics to what they leave, so that these stay exact where the cells do not determine those.
   */
  template <int dim>
  class QuadraticFit
  {
  public:
    static constexpr unsigned int n_terms = Monomials<dim>::n_terms;

    /// A cell of the stencil: distance of its centroid from that of the cell in the middle [m], mean of the
    /// squares of distances from its own [m^2].
    struct Cell
    {
      dealii::Tensor<1, dim>          distance;
      dealii::SymmetricTensor<2, dim> second_moment;
    };

    /// @param own second moment of the cell in the middle
    /// @param others without that cell
    void reinit(const dealii::SymmetricTensor<2, dim> &own, const std::vector<Cell> &others);

    /// Whether the cells determine all linear terms, and all terms.
    bool is_solid() const { return solid; }
    bool is_complete() const { return n_kept == n_quadratic; }
    /// How many quadratic terms they determine.
    unsigned int n_determined() const { return n_kept; }

    /// What the mean of each other cell over that in the middle adds to the coefficients of the monomials
    /// [1/m], [1/m^2].
    const std::vector<std::array<double, n_terms>> &rows() const { return result; }

  private:
    static constexpr unsigned int n_quadratic = Monomials<dim>::n_quadratic;
    using Metric                              = Eigen::Matrix<double, dim, dim>;
    using Rows      = Eigen::Matrix<double, Eigen::Dynamic, n_terms, Eigen::RowMajor>;
    using Quadratic = Eigen::Matrix<double, n_quadratic, n_quadratic>;

    void      find_metric(const std::vector<Cell> &others);
    void      fill_rows(const dealii::SymmetricTensor<2, dim> &own, const std::vector<Cell> &others);
    Quadratic inverse_of(const Quadratic &gram, const double size);
    void      solve();

    Metric                                   metric;
    Rows                                     rows_of_means;
    Eigen::VectorXd                          weight;
    std::vector<std::array<double, n_terms>> result;
    bool                                     solid  = false;
    unsigned int                             n_kept = 0;
  };
} // namespace perideal

#endif
