// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/least_squares.h>
#include <perideal/materials/moment_conditions.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace perideal
{
  namespace
  {
    /// The directions multiplied in each monomial: XOSB eqs. (43), (37), (63), (57).
    template <int dim, int order>
    struct MonomialsOfOrder;

    template <>
    struct MonomialsOfOrder<2, 2>
    {
      static constexpr int factors[3][2] = {{0, 0}, {1, 1}, {0, 1}};
    };

    template <>
    struct MonomialsOfOrder<3, 2>
    {
      static constexpr int factors[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
    };

    template <>
    struct MonomialsOfOrder<2, 4>
    {
      static constexpr int factors[5][4] = {
        {0, 0, 0, 0}, {1, 1, 1, 1}, {0, 0, 1, 1}, {0, 0, 0, 1}, {1, 1, 1, 0}};
    };

    template <>
    struct MonomialsOfOrder<3, 4>
    {
      static constexpr int factors[15][4] = {{0, 0, 0, 0},
                                             {1, 1, 1, 1},
                                             {2, 2, 2, 2},
                                             {0, 0, 1, 1},
                                             {1, 1, 2, 2},
                                             {2, 2, 0, 0},
                                             {0, 0, 0, 1},
                                             {0, 0, 0, 2},
                                             {1, 1, 1, 0},
                                             {1, 1, 1, 2},
                                             {2, 2, 2, 0},
                                             {2, 2, 2, 1},
                                             {0, 0, 1, 2},
                                             {1, 1, 0, 2},
                                             {2, 2, 0, 1}};
    };

    /// Products of two monomials are the same for many pairs of them, in 3-D and order 4
    /// 45 different ones for 120 pairs. Of each pair (k, l <= k) the first with the same product.
    template <int dim, int order>
    struct EqualProducts
    {
      static constexpr int n = MomentConditions<dim, order>::n_conditions;

      EqualProducts()
      {
        std::map<std::array<int, dim>, std::pair<int, int>> first_with;
        for (int k = 0; k < n; ++k)
          for (int l = 0; l <= k; ++l)
            {
              std::array<int, dim> exponents = {};
              for (const int monomial : {k, l})
                for (const int direction : MonomialsOfOrder<dim, order>::factors[monomial])
                  ++exponents[direction];
              first[k][l] = first_with.insert({exponents, {k, l}}).first->second;
            }
      }

      std::pair<int, int> first[n][n];
    };

    /// r of a monomial: how often each direction occurs decides (eqs. 41, 61).
    double target_of(const int (&factors)[2])
    {
      return factors[0] == factors[1] ? 1. : 0.;
    }

    double target_of(const int (&factors)[4])
    {
      if (factors[0] != factors[1] || factors[2] != factors[3])
        return 0.;
      return factors[0] == factors[2] ? 1.5 : 0.5;
    }

    /// Relative size of eigenvalues that count as zero in the pseudo-inverse.
    constexpr double rank_tolerance = 1e-10;

    /// Length over the horizon up to which a family has no extent but rounding in a direction.
    constexpr double flat_tolerance = 1e-10;
  } // namespace

  template <int dim, int order>
  void MomentConditions<dim, order>::reinit(const FamilyView<dim> &family)
  {
    using Array          = Eigen::Map<const Eigen::ArrayXd>;
    const Eigen::Index n = family.size;
    horizon_square       = family.horizon * family.horizon;
    volume               = Array(family.volume.data(), n);
    monomials.resize(n, n_conditions);
    const Array           length_square(family.length_square.data(), n);
    std::array<bool, dim> is_flat;
    for (int d = 0; d < dim; ++d)
      is_flat[d] = !(Array(family.bond[d].data(), n).abs() > flat_tolerance * family.horizon).any();
    for (int k = 0; k < n_conditions; ++k)
      {
        const auto &factors = MonomialsOfOrder<dim, order>::factors[k];
        auto        column  = monomials.col(k).array();
        target[k]           = target_of(factors) / horizon_square;
        if (std::any_of(std::begin(factors), std::end(factors), [&](const int d) { return is_flat[d]; }))
          {
            // A condition that its bonds cannot meet, as where all of them lie in a plane to the last bit.
            column = 0.;
            continue;
          }
        column = Array(family.bond[factors[0]].data(), n) * Array(family.bond[factors[1]].data(), n);
        if constexpr (order == 4)
          column *= Array(family.bond[factors[2]].data(), n) * Array(family.bond[factors[3]].data(), n) /
                    length_square;
        column /= horizon_square;
      }
    gram    = sum_of_products(volume);
    scaling = gram.diagonal().array().max(1e-300).sqrt().inverse();
    gram    = scaling.asDiagonal() * gram * scaling.asDiagonal();
  }

  template <int dim, int order>
  typename MomentConditions<dim, order>::Matrix
  MomentConditions<dim, order>::sum_of_products(const Eigen::ArrayXd &volumes) const
  {
    static const EqualProducts<dim, order> equal;
    Matrix                                 result;
    Eigen::VectorXd                        weighted(volumes.size());
    for (int k = 0; k < n_conditions; ++k)
      {
        weighted = monomials.col(k).array() * volumes;
        for (int l = 0; l <= k; ++l)
          {
            const auto first = equal.first[k][l];
            result(k, l) = result(l, k) = first == std::make_pair(k, l) ? weighted.dot(monomials.col(l)) :
                                                                          result(first.first, first.second);
          }
      }
    return result;
  }

  template <int dim, int order>
  typename MomentConditions<dim, order>::Vector
  MomentConditions<dim, order>::miss(const Eigen::Ref<const Eigen::ArrayXd> &weights) const
  {
    return target - monomials.transpose() * (weights * volume).matrix();
  }

  template <int dim, int order>
  typename MomentConditions<dim, order>::Vector
  MomentConditions<dim, order>::solve(const Vector &right_hand_side) const
  {
    const Vector scaled = scaling.cwiseProduct(right_hand_side);
    return scaling.cwiseProduct(solve_semidefinite(gram, scaled, rank_tolerance));
  }

  template <int dim, int order>
  double MomentConditions<dim, order>::correct(std::vector<double> &weights) const
  {
    Weights w(weights.data(), weights.size());
    // The second pass removes what round-off left of the conditions.
    for (int pass = 0; pass < 2; ++pass)
      w += (monomials * solve(miss(w))).array();
    return miss(w).cwiseAbs().maxCoeff() * horizon_square;
  }

  template <int dim, int order>
  bool MomentConditions<dim, order>::correct_nonnegative(const std::vector<double> &spherical,
                                                         std::vector<double>       &weights) const
  {
    // The bounded minimiser is w = max(0, ws + lambda.m), where lambda minimises
    // the convex dual 1/2 sum V w^2 - lambda.r. Newton's method on it, lambda in
    // scaled coordinates, the bounds that are active taken as they stand.
    const Eigen::Map<const Eigen::ArrayXd> ws(spherical.data(), spherical.size());
    const Vector                           scaled_target = scaling.cwiseProduct(target);
    const double                           size          = scaled_target.cwiseAbs().maxCoeff();

    struct Iterate
    {
      Vector         lambda, gradient;
      Eigen::ArrayXd weights;
      double         dual;
    };
    const auto evaluate = [&](const Vector &lambda) {
      Iterate at;
      at.lambda   = lambda;
      at.weights  = (ws + (monomials * scaling.cwiseProduct(lambda)).array()).max(0.);
      at.gradient = -scaling.cwiseProduct(miss(at.weights));
      at.dual     = 0.5 * (at.weights.square() * volume).sum() - scaled_target.dot(lambda);
      return at;
    };

    Iterate now = evaluate(Vector::Zero());
    for (unsigned int iteration = 0; iteration < 50 && now.gradient.cwiseAbs().maxCoeff() > 1e-15 * size;
         ++iteration)
      {
        const Eigen::ArrayXd active  = (now.weights > 0).select(volume, 0.);
        Matrix               hessian = scaling.asDiagonal() * sum_of_products(active) * scaling.asDiagonal();
        hessian.diagonal().array() += 1e-14;
        const Vector step  = Eigen::LDLT<Matrix>(hessian).solve(-now.gradient);
        const double slope = now.gradient.dot(step);
        bool         moved = false;
        for (double length = 1; length > 1e-6 && !moved; length *= 0.5)
          {
            Iterate next = evaluate(now.lambda + length * step);
            // Near the minimum the dual changes less than round-off; the gradient tells.
            moved = next.dual < now.dual + 1e-4 * length * slope ||
                    next.gradient.squaredNorm() < 0.25 * now.gradient.squaredNorm();
            if (moved)
              now = std::move(next);
          }
        if (!moved)
          break;
      }
    Weights(weights.data(), weights.size()) = now.weights;
    return miss(now.weights).cwiseAbs().maxCoeff() * horizon_square <= tolerance;
  }

  template class MomentConditions<2, 2>;
  template class MomentConditions<2, 4>;
  template class MomentConditions<3, 2>;
  template class MomentConditions<3, 4>;
} // namespace perideal
