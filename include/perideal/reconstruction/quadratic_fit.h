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
   * weigh as their undeformed images would; weights are share exp(-decay |y|^2). Linear terms are fitted
   * first and quadratics to what they leave, so that these stay exact where the cells do not determine those.
   */
  template <int dim>
  class QuadraticFit
  {
  public:
    static constexpr unsigned int n_terms = Monomials<dim>::n_terms;
    using Terms                           = std::array<double, n_terms>;

    /// A cell of the stencil: distance of its centroid from that of the cell in the middle [m], mean of the
    /// squares of distances from its own [m^2], share of the weight that its distance gives it.
    struct Cell
    {
      dealii::Tensor<1, dim>          distance;
      dealii::SymmetricTensor<2, dim> second_moment;
      double                          share = 1.;
    };

    /// @param own second moment of the cell in the middle, or zero where values stand for means
    /// @param others without that cell
    /// @param size second moment of the cell in the middle, by which a layer of cells is told from two
    /// @param decay of the weights; the flatter, the smaller the largest eigenvalue of a body, the larger
    /// errors
    void reinit(const dealii::SymmetricTensor<2, dim> &own,
                const std::vector<Cell>               &others,
                const dealii::SymmetricTensor<2, dim> &size,
                const double                           decay = 0.5);

    /// Whether the cells determine all linear terms, and all terms.
    bool is_solid() const { return solid; }
    bool is_complete() const { return n_kept == n_quadratic; }
    /// How many quadratic terms they determine.
    unsigned int n_determined() const { return n_kept; }

    /// What the mean of each other cell over that in the middle adds to the coefficients of the monomials
    /// [1/m], [1/m^2].
    const std::vector<Terms> &rows() const { return result; }

    /// Returns the polynomials without a constant that the fit leaves out, of which the means say nothing or
    /// too little, as coefficients of the monomials; n_quadratic - n_determined() of them that are
    /// independent. Of a body two cells thick, (x - s).n (x - t).n between middles s and t of the layers.
    std::vector<Terms> undetermined() const;

    /// Whether all that is left out is accounted for by squares of distances along the normals of surfaces:
    /// the body is two cells thick there.
    /// @param surfaces area vectors or normals, either sign
    bool misses_only_across(const std::vector<dealii::Tensor<1, dim>> &surfaces) const;

    /// Returns such squares as coefficients of the monomials, as many as there are undetermined()
    /// polynomials; where they do not account for all that is left out, the quadratic parts of those.
    std::vector<Terms> squares_across(const std::vector<dealii::Tensor<1, dim>> &surfaces) const;

  private:
    static constexpr unsigned int n_quadratic = Monomials<dim>::n_quadratic;
    using Metric                              = Eigen::Matrix<double, dim, dim>;
    using Rows           = Eigen::Matrix<double, Eigen::Dynamic, n_terms, Eigen::RowMajor>;
    using Quadratic      = Eigen::Matrix<double, n_quadratic, n_quadratic>;
    using LinearTerms    = Eigen::Matrix<double, dim, 1>;
    using QuadraticTerms = Eigen::Matrix<double, n_quadratic, 1>;
    /// At most n_quadratic columns.
    using Directions =
      Eigen::Matrix<double, n_quadratic, Eigen::Dynamic, Eigen::ColMajor, n_quadratic, n_quadratic>;

    void      find_metric(const std::vector<Cell> &others, const dealii::SymmetricTensor<2, dim> &size);
    void      fill_rows(const dealii::SymmetricTensor<2, dim> &own,
                        const std::vector<Cell>               &others,
                        const double                           decay);
    Quadratic inverse_of(const Quadratic &gram, const double size);
    void      solve();
    /// Mean of q (x) q over the squares q that are nearer to what is left out than to the other quadratics.
    Quadratic squares_of(const std::vector<dealii::Tensor<1, dim>> &surfaces) const;
    /// Coefficients of the monomials of x to those of their images, mixed ones scaled by the root of two.
    Terms terms_of_x(const LinearTerms &linear, const QuadraticTerms &quadratic) const;

    Metric             metric;
    Rows               rows_of_means;
    Eigen::VectorXd    weight;
    std::vector<Terms> result;
    bool               solid  = false;
    unsigned int       n_kept = 0;
    /// Linear terms that go with quadratics, and the quadratics that are left out.
    Eigen::Matrix<double, dim, n_quadratic> shift;
    Directions                              dropped;
  };
} // namespace perideal

#endif
