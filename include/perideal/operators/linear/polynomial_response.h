// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_operators_linear_polynomial_response_h
#define perideal_operators_linear_polynomial_response_h

#include <perideal/boundary/taylor_fit.h>
#include <perideal/operators/linear/bond_operator.h>

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace perideal
{
  /**
   * Computes the forces K T of a bond operator on each owned node when the whole body displaces by a
   * polynomial T of second degree about it. A family that is whole has none under a uniform strain, and under
   * a strain that varies those of a body of the stiffness that its bonds have by their own quadrature,
   *
   *     (K T)_i = -V_i div(C:grad T),
   *
   * from which that stiffness is found. On lattices with few cells a horizon it differs from the material's
   * by some per cent.
   */
  template <int dim>
  class PolynomialResponse
  {
  public:
    using Basis = TaylorBasis<dim>;
    using Map   = Eigen::Matrix<double, dim, Basis::n_coefficients>;

    /// Collective. The families must outlive this object.
    PolynomialResponse(const BondOperator<dim> &bonds, const Families<dim> &families);

    /// Whether a uniform gradient leaves a node without balance.
    bool lacks_bonds(const LocalIndex i) const { return of_gradients[i].norm() > tolerance; }

    /// K T [N] by the coefficients of T.
    Map force(const LocalIndex i) const;
    /// The same by the coefficients of first order alone, those of second order left out.
    Map force_of_gradient(const LocalIndex i) const;

    /// V div(C:grad T) [N] by the coefficients of T.
    static Map
    divergence(const dealii::SymmetricTensor<4, dim> &stiffness, const double volume, const double spacing);

    /// C [Pa] of the families of some nodes of one material, the mean over all ranks; nothing where there are
    /// no such nodes. Collective.
    /// @param counts by owned node, 1 for nodes far from the surface
    std::optional<dealii::SymmetricTensor<4, dim>> stiffness(const std::vector<std::uint8_t> &counts) const;

  private:
    /// Force on a node under u_c = x_l.
    auto under_gradient(const LocalIndex i, const unsigned int c, const unsigned int l) const
    {
      return of_gradients[i].col(dim * c + l);
    }

    /// K u of the owned nodes, a column for each.
    Eigen::Matrix<double, dim, Eigen::Dynamic>
    response(const std::function<dealii::Tensor<1, dim>(const dealii::Tensor<1, dim> &)> &displacement) const;

    const BondOperator<dim> &bonds;
    const Families<dim>     &families;
    dealii::Point<dim>       middle;
    /// Under gradients of 1, rotations included, which bonds with tensors resist near the surface; and under
    /// second derivatives of 1 by component, about the middle.
    using OfGradients = Eigen::Matrix<double, dim, dim * dim>;
    using OfCurvature = Eigen::Matrix<double, dim, dim * Basis::n_pairs>;
    std::vector<OfGradients, Eigen::aligned_allocator<OfGradients>> of_gradients;
    std::vector<OfCurvature, Eigen::aligned_allocator<OfCurvature>> of_curvature;
    double                                                          tolerance = 0;
  };
} // namespace perideal

#endif
