// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef perideal_materials_moment_conditions_h
#define perideal_materials_moment_conditions_h

#include <perideal/materials/linear_model.h>

#include <Eigen/Core>

#include <vector>

namespace perideal
{
  /**
   * Weights of a family that meet the moment conditions of XOSB exactly and
   * differ from given spherical weights as little as possible:
   *
   *     minimise  1/2 sum_j (w_j - ws_j)^2 V_j   subject to   sum_j w_j m(xi_j) V_j = r
   *
   * with, for order 2 (dilatation, eqs. 30-44), m = products xi_a xi_b and
   * r = delta_ab, and for order 4 (deviatoric energy, eqs. 45-64),
   * m = products xi_a xi_b xi_c xi_d/|xi|^2 and r = 3/2 for equal, 1/2 for
   * pairwise equal, 0 for other indices. The minimiser is w = ws + lambda.m.
   */
  template <int dim, int order>
  class MomentConditions
  {
  public:
    /// 3 and 5 in 2-D, 6 and 15 in 3-D.
    static constexpr int n_conditions = order == 2 ? dim * (dim + 1) / 2 : (dim == 2 ? 5 : 15);

    using Vector = Eigen::Matrix<double, n_conditions, 1>;
    using Matrix = Eigen::Matrix<double, n_conditions, n_conditions>;

    /// Largest miss of a condition, relative to r, that still counts as met;
    /// round-off leaves a few 1e-15.
    static constexpr double tolerance = 1e-12;

    /// Tabulates the monomials of a family.
    void reinit(const FamilyView<dim> &family);

    /// Adds lambda.m to @p weights, which enter as the spherical ones. Where
    /// the conditions depend on each other, a pseudo-inverse finds the
    /// smallest change that meets them best.
    /// Returns the largest miss of a condition, relative to r.
    double correct(std::vector<double> &weights) const;

    /// As correct(), with the bounds w_j >= 0: a small quadratic programme.
    /// Returns false when no such weights exist; @p weights are of no use then.
    bool correct_nonnegative(const std::vector<double> &spherical, std::vector<double> &weights) const;

  private:
    using Weights = Eigen::Map<Eigen::ArrayXd>;

    Vector miss(const Eigen::Ref<const Eigen::ArrayXd> &weights) const;
    Vector solve(const Vector &right_hand_side) const;
    /// sum_j m m^T V_j over the members, for any volumes.
    Matrix sum_of_products(const Eigen::ArrayXd &volumes) const;

    /// Monomials over horizon^2 by member (row), volumes of the members.
    Eigen::Matrix<double, Eigen::Dynamic, n_conditions> monomials;
    Eigen::ArrayXd                                      volume;
    /// Right-hand side over horizon^2.
    Vector target;
    double horizon_square = 1;
    /// sum_j m m^T V_j, scaled to a unit diagonal.
    Matrix gram;
    Vector scaling;
  };
} // namespace perideal

#endif
