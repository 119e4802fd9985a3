// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/base/least_squares.h>
#include <perideal/problem/carried_state.h>
#include <perideal/reconstruction/quadratic_terms.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

// CarriedState: polynomials of smooth fields, and what halves of cells have of them.

namespace perideal
{
  namespace
  {
    /// Eigenvalues of normal equations, over the largest, that count as zero.
    constexpr double rank_tolerance = 1e-8;

    /// A node and one that a whole bond joins to it.
    using Pairs = std::vector<std::pair<LocalIndex, LocalIndex>>;

    /// Fits polynomials without their constants to the differences of values to those of a node.
    template <int dim>
    class PolynomialFit
    {
    public:
      static constexpr unsigned int n_coefficients = dim + dim * (dim + 1) / 2;

      PolynomialFit(const double spacing, const std::size_t n_values)
        : spacing(spacing)
        , right(decltype(right)::Zero(n_coefficients, n_values))
      {
      }

      /// Adds a node at a distance [m], whose values differ by so much.
      template <typename Difference>
      void add(const dealii::Tensor<1, dim> &distance, const Difference &difference)
      {
        const dealii::Tensor<1, dim> d      = distance / spacing;
        const double                 weight = 1. / d.norm_square();
        const QuadraticTerms<dim>    p      = quadratic_terms(d);
        moments.noalias() += weight * p * p.transpose();
        for (Eigen::Index k = 0; k < right.cols(); ++k)
          right.col(k) += weight * difference(k) * p;
      }

      /// Writes the coefficients of each value.
      void solve(double *coefficients) const
      {
        // Scaled to a unit diagonal, as fits to few points, all on a line, may be singular.
        QuadraticTerms<dim> scale = moments.diagonal();
        for (unsigned int k = 0; k < n_coefficients; ++k)
          scale[k] = scale[k] > 0 ? 1. / std::sqrt(scale[k]) : 0.;
        const Eigen::MatrixXd  scaled = scale.asDiagonal() * moments * scale.asDiagonal();
        dealii::Tensor<1, dim> of_length;
        for (int d = 0; d < dim; ++d)
          of_length[d] = 1. / spacing;
        const QuadraticTerms<dim> unit = quadratic_terms(of_length);
        for (Eigen::Index k = 0; k < right.cols(); ++k)
          {
            const Eigen::VectorXd scaled_right = scale.asDiagonal() * right.col(k);
            const Eigen::VectorXd solution     = solve_semidefinite(scaled, scaled_right, rank_tolerance);
            for (unsigned int c = 0; c < n_coefficients; ++c)
              coefficients[k * n_coefficients + c] = unit[c] * scale[c] * solution[c];
          }
      }

    private:
      double                                                spacing;
      Eigen::Matrix<double, n_coefficients, n_coefficients> moments =
        Eigen::Matrix<double, n_coefficients, n_coefficients>::Zero();
      Eigen::Matrix<double, n_coefficients, Eigen::Dynamic> right;
    };
  } // namespace

  template <int dim>
  void CarriedState<dim>::fit(const Problem<dim> &problem, const MeshNeed<dim> &need)
  {
    if (n_smooth == 0)
      return;
    const Families<dim>   &families = *problem.discretisation.families;
    const BondList        &list     = problem.force->body_bonds();
    const auto             is_cut   = problem.failure.precrack_test();
    const std::size_t      first    = n_places + n_constant;
    std::vector<Numbers *> of_node(families.n_owned());
    std::vector<Cell>      cell_of(families.n_owned());
    std::vector<bool>      is_fitted(families.n_owned()), is_halved(families.n_owned());
    const auto             largest = need.largest_widths(*problem.body.mesh);
    for (const auto &cell : problem.body.mesh->triangulation.active_cell_iterators())
      if (Numbers &numbers = numbers_of_cell[cell->active_cell_index()]; !numbers.empty())
        {
          const LocalIndex i = problem.body.nodes->node_of_cell[cell->active_cell_index()];
          of_node[i]         = &numbers;
          cell_of[i]         = cell;
          is_halved[i]       = numbers[is_kept] == 0 && need.is_near_halved(cell, largest, 0.);
          is_fitted[i]       = need.is_near_halved(cell, largest, largest.cell);
        }
    NodalVector values(families.make_partitioner(n_smooth));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      for (std::size_t k = 0; k < n_smooth; ++k)
        values.local_element(n_smooth * i + k) = (*of_node[i])[first + k];
    values.update_ghost_values();

    Pairs pairs;
    for (LocalIndex i = 0; i < list.n_rows(); ++i)
      for (BondIndex slot = list.row[i]; slot < list.row[i + 1]; ++slot)
        {
          const LocalIndex j       = list.neighbour[slot];
          const bool       of_near = is_fitted[i], of_far = j < families.n_owned() && is_fitted[j];
          if (j == i || !(of_near || of_far) ||
              (is_cut && is_cut(families.position[i], families.position[j])))
            continue;
          if (of_near)
            pairs.emplace_back(i, j);
          if (of_far)
            pairs.emplace_back(j, i);
        }

    std::vector<PolynomialFit<dim>> fits;
    std::vector<LocalIndex>         fit_of(families.n_owned());
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (is_fitted[i])
        {
          fit_of[i] = fits.size();
          fits.emplace_back(families.spacing[i], n_smooth);
        }
    for (const auto &[i, j] : pairs)
      fits[fit_of[i]].add(families.position[j] - families.position[i], [&, i = i, j = j](const auto k) {
        return values.local_element(n_smooth * j + k) - values.local_element(n_smooth * i + k);
      });
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (is_fitted[i])
        fits[fit_of[i]].solve(of_node[i]->data() + first + n_smooth);
    fits.clear();

    // Polynomials whose mean over the halves of their cell is the value of its node.
    const std::size_t width = n_smooth * (1 + n_coefficients);
    NodalVector       polynomials(families.make_partitioner(width));
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (is_fitted[i])
        {
          const double       *coefficients = of_node[i]->data() + first + n_smooth;
          QuadraticTerms<dim> mean         = QuadraticTerms<dim>::Zero();
          for (unsigned int c = 0; c < n_halves; ++c)
            mean += quadratic_terms(offset_of_half(cell_of[i], c)) / n_halves;
          for (std::size_t k = 0; k < n_smooth; ++k)
            {
              double middle = values.local_element(n_smooth * i + k);
              for (unsigned int c = 0; c < n_coefficients; ++c)
                {
                  const double coefficient = coefficients[k * n_coefficients + c];
                  middle -= coefficient * mean[c];
                  polynomials.local_element(width * i + k * (1 + n_coefficients) + 1 + c) = coefficient;
                }
              polynomials.local_element(width * i + k * (1 + n_coefficients)) = middle;
            }
        }
    polynomials.update_ghost_values();

    std::vector<std::array<double, n_halves>> sum_of_weights(families.n_owned());
    std::vector<dealii::Tensor<2, dim>>       to_unit(families.n_owned());
    const auto                                add = [&](const LocalIndex i, const LocalIndex j) {
      const dealii::Tensor<1, dim> to_far = families.position[j] - families.position[i],
                                   unit = to_unit[i] * to_far;
      for (unsigned int c = 0; c < n_halves; ++c)
        {
          double weight = 1;
          for (int d = 0; d < dim; ++d)
            weight *= std::max(0., 1. - std::abs(unit[d] - unit_offset_of_half(c)[d]));
          if (weight == 0.)
            continue;
          sum_of_weights[i][c] += weight;
          const QuadraticTerms<dim> p = quadratic_terms(offset_of_half(cell_of[i], c) - to_far);
          double                   *half = of_node[i]->data() + first_half() + n_smooth * c;
          for (std::size_t k = 0; k < n_smooth; ++k)
            {
              const std::size_t at    = width * j + k * (1 + n_coefficients);
              double            value = polynomials.local_element(at);
              for (unsigned int t = 0; t < n_coefficients; ++t)
                value += polynomials.local_element(at + 1 + t) * p[t];
              half[k] += weight * value;
            }
        }
    };
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (is_halved[i])
        {
          to_unit[i]                = invert(axes_of(cell_of[i]));
          (*of_node[i])[has_halves] = 1.;
          add(i, i);
        }
    for (const auto &[i, j] : pairs)
      if (is_halved[i])
        add(i, j);
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (is_halved[i])
        for (unsigned int c = 0; c < n_halves; ++c)
          for (std::size_t k = 0; k < n_smooth; ++k)
            (*of_node[i])[first_half() + n_smooth * c + k] /= sum_of_weights[i][c];
  }

  PERIDEAL_INSTANTIATE_CLASS(CarriedState)
} // namespace perideal
