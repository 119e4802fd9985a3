// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_reconstruction_elastic_fit_h
#define perideal_reconstruction_elastic_fit_h

#include <perideal/parameters/elastic_solid.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace perideal
{
  /**
   * Fits a cubic displacement by weighted least squares to what is
   * known of an elastic body around a point: displacements, tractions, and that
   * stresses are in equilibrium,
   *
   *     C_ipkq u_k,pq + b_i = 0.
   *
   * All equations are brought to the dimension of a displacement, with lengths in
   * units of the scale and stresses in units of 2 mu, of the isotropic solid that is
   * nearest. The equilibrium is what
   * makes a cubic of few data: it and the tractions of a free surface say how
   * strains vary with depth, which nodes at two depths do not.
   */
  template <int dim>
  class ElasticFit
  {
  public:
    /// Begins without equations. @param scale size of the cells [m]
    /// @param offset any displacement near the ones to come, for round-off
    ElasticFit(const dealii::Point<dim>     &centre,
               const double                  scale,
               const dealii::Tensor<1, dim> &offset,
               const ElasticSolid<dim>      &solid);

    /// u_component(point) = value [m].
    void add_displacement(const dealii::Point<dim> &point,
                          const unsigned int        component,
                          const double              value,
                          const double              weight);

    /// (sigma normal)_component(point) = value [Pa].
    void add_traction(const dealii::Point<dim>     &point,
                      const dealii::Tensor<1, dim> &normal,
                      const unsigned int            component,
                      const double                  value,
                      const double                  weight);

    /// Equilibrium at a point under a body force [N/m^3].
    void add_equilibrium(const dealii::Point<dim>     &point,
                         const dealii::Tensor<1, dim> &body_force,
                         const double                  weight);

    /// Displacement and its gradient (component, direction) at the centre.
    struct Result
    {
      dealii::Tensor<1, dim> displacement;
      dealii::Tensor<2, dim> gradient;
    };
    /// Solves the equations; coefficients that they do not determine are small, the more so the higher their
    /// degree.
    Result solve() const;

  private:
    static constexpr unsigned int n_monomials = dim == 2 ? 10 : 20;
    static constexpr unsigned int n_unknowns  = dim * n_monomials;
    using Powers                              = std::array<unsigned int, dim>;
    using Row                                 = std::array<double, n_unknowns>;

    /// Exponents of all monomials: 1, the dim linear ones, the quadratic, the cubic ones.
    static const std::array<Powers, n_monomials> &monomials();

    dealii::Tensor<1, dim> scaled(const dealii::Point<dim> &point) const { return (point - centre) / scale; }

    /// Adds factor times a derivative of a component at @p x (scaled) to an equation.
    static void add_term(Row                          &row,
                         const unsigned int            component,
                         const Powers                 &derivative,
                         const dealii::Tensor<1, dim> &x,
                         const double                  factor);

    void add_equation(const Row &row, const double value, const double weight);

    dealii::Point<dim>     centre;
    double                 scale;
    dealii::Tensor<1, dim> offset;
    /// 2 mu [Pa], and C in units of it.
    double                          twice_mu;
    dealii::SymmetricTensor<4, dim> stiffness;

    std::vector<double> matrix, right_hand_side;
  };
} // namespace perideal

#endif
