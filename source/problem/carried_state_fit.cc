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

    /// Fits polynomials without their constants to the differences of values to those of a node.
    template <int dim>
    class PolynomialFit
    {
    public:
      static constexpr unsigned int n_coefficients = QuadraticTerms<dim>::RowsAtCompileTime;

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
  dealii::Tensor<2, dim> CarriedState<dim>::axes_of(const Cell &cell)
  {
    dealii::Tensor<2, dim> result;
    for (const unsigned int v : cell->vertex_indices())
      for (int a = 0; a < dim; ++a)
        for (int d = 0; d < dim; ++d)
          result[d][a] += ((v >> a) & 1 ? 2. : -2.) / n_halves * cell->vertex(v)[d];
    return result;
  }

  template <int dim>
  dealii::Tensor<1, dim> CarriedState<dim>::unit_offset_of_half(const unsigned int half)
  {
    dealii::Point<dim> middle;
    for (int d = 0; d < dim; ++d)
      middle[d] = 0.5;
    return dealii::GeometryInfo<dim>::child_to_cell_coordinates(middle, half) - middle;
  }

  template <int dim>
  dealii::Tensor<1, dim> CarriedState<dim>::offset_of_half(const Cell &cell, const unsigned int half)
  {
    return axes_of(cell) * unit_offset_of_half(half);
  }

  template <int dim>
  struct CarriedState<dim>::Fitting
  {
    const Families<dim> &families;
    /// By owned node.
    std::vector<Numbers *> numbers;
    std::vector<Cell>      cell;
    /// Whether its cell may be halved, and whether one within its reach may.
    std::vector<bool> is_halved, is_fitted;
    /// Owned nodes that are fitted, and those that whole bonds join to them.
    std::vector<std::pair<LocalIndex, LocalIndex>> pairs = {};
    /// Smooth values.
    NodalVector values = {};
  };

  template <int dim>
  void CarriedState<dim>::fit(const Problem<dim> &problem, const MeshNeed<dim> &need)
  {
    if (n_smooth == 0)
      return;
    const Families<dim> &families = *problem.discretisation.families;
    const LocalIndex     n        = families.n_owned();
    Fitting              fitting{
      families, std::vector<Numbers *>(n), std::vector<Cell>(n), std::vector<bool>(n), std::vector<bool>(n)};
    const auto largest = need.largest_widths(*problem.body.mesh);
    for (const auto &cell : problem.body.mesh->triangulation.active_cell_iterators())
      if (Numbers &numbers = numbers_of_cell[cell->active_cell_index()]; !numbers.empty())
        {
          const LocalIndex i   = problem.body.nodes->node_of_cell[cell->active_cell_index()];
          fitting.numbers[i]   = &numbers;
          fitting.cell[i]      = cell;
          fitting.is_halved[i] = numbers[fate] < CellFate::stays && need.is_near_halved(cell, largest, 0.);
          // Halves take polynomials of nodes nearer than one and a quarter of an edge.
          fitting.is_fitted[i] = need.is_near_halved(cell, largest, 2. * largest.cell);
        }
    fitting.values.reinit(families.make_partitioner(n_smooth));
    for (LocalIndex i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n_smooth; ++k)
        fitting.values.local_element(n_smooth * i + k) = (*fitting.numbers[i])[n_places + n_constant + k];
    fitting.values.update_ghost_values();

    const BondList &list   = problem.force->body_bonds();
    const auto      is_cut = problem.failure.precrack_test();
    for (LocalIndex i = 0; i < list.n_rows(); ++i)
      for (BondIndex slot = list.row[i]; slot < list.row[i + 1]; ++slot)
        {
          const LocalIndex j       = list.neighbour[slot];
          const bool       of_near = fitting.is_fitted[i], of_far = j < n && fitting.is_fitted[j];
          if (j == i || !(of_near || of_far) ||
              (is_cut && is_cut(families.position[i], families.position[j])))
            continue;
          if (of_near)
            fitting.pairs.emplace_back(i, j);
          if (of_far)
            fitting.pairs.emplace_back(j, i);
        }
    fit_polynomials(fitting);
    find_halves(fitting, centred_polynomials(fitting));
  }

  template <int dim>
  void CarriedState<dim>::fit_polynomials(Fitting &fitting) const
  {
    const Families<dim>            &families = fitting.families;
    std::vector<PolynomialFit<dim>> fits;
    std::vector<LocalIndex>         fit_of(families.n_owned());
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (fitting.is_fitted[i])
        {
          fit_of[i] = fits.size();
          fits.emplace_back(families.spacing[i], n_smooth);
        }
    for (const auto &[i, j] : fitting.pairs)
      fits[fit_of[i]].add(families.position[j] - families.position[i], [&, i = i, j = j](const auto k) {
        return fitting.values.local_element(n_smooth * j + k) -
               fitting.values.local_element(n_smooth * i + k);
      });
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (fitting.is_fitted[i])
        fits[fit_of[i]].solve(fitting.numbers[i]->data() + first_coefficient());
  }

  template <int dim>
  NodalVector CarriedState<dim>::centred_polynomials(const Fitting &fitting) const
  {
    const std::size_t width = 1 + n_coefficients;
    NodalVector       result(fitting.families.make_partitioner(n_smooth * width));
    for (LocalIndex i = 0; i < fitting.families.n_owned(); ++i)
      if (fitting.is_fitted[i])
        {
          const double       *coefficients = fitting.numbers[i]->data() + first_coefficient();
          QuadraticTerms<dim> mean         = QuadraticTerms<dim>::Zero();
          for (unsigned int half = 0; half < n_halves; ++half)
            mean += quadratic_terms(offset_of_half(fitting.cell[i], half)) / n_halves;
          for (std::size_t k = 0; k < n_smooth; ++k)
            {
              const std::size_t at     = (n_smooth * i + k) * width;
              double            middle = fitting.values.local_element(n_smooth * i + k);
              for (unsigned int c = 0; c < n_coefficients; ++c)
                {
                  const double coefficient = coefficients[k * n_coefficients + c];
                  middle -= coefficient * mean[c];
                  result.local_element(at + 1 + c) = coefficient;
                }
              result.local_element(at) = middle;
            }
        }
    result.update_ghost_values();
    return result;
  }

  template <int dim>
  void CarriedState<dim>::find_halves(Fitting &fitting, const NodalVector &polynomials) const
  {
    const Families<dim>                      &families = fitting.families;
    const std::size_t                         width    = 1 + n_coefficients;
    std::vector<std::array<double, n_halves>> sum_of_weights(families.n_owned());
    std::vector<dealii::Tensor<2, dim>>       axes(families.n_owned()), to_unit(families.n_owned());
    const auto                                add = [&](const LocalIndex i, const LocalIndex j) {
      const dealii::Tensor<1, dim> to_far = families.position[j] - families.position[i],
                                   unit = to_unit[i] * to_far;
      for (unsigned int half = 0; half < n_halves; ++half)
        {
          const dealii::Tensor<1, dim> of_half = unit_offset_of_half(half);
          double                       weight  = 1;
          for (int d = 0; d < dim; ++d)
            weight *= std::max(0., 1. - std::abs(unit[d] - of_half[d]));
          if (weight == 0.)
            continue;
          sum_of_weights[i][half] += weight;
          const QuadraticTerms<dim> terms = quadratic_terms<dim>(axes[i] * of_half - to_far);
          double                   *values = fitting.numbers[i]->data() + first_half() + n_smooth * half;
          for (std::size_t k = 0; k < n_smooth; ++k)
            {
              const std::size_t at    = (n_smooth * j + k) * width;
              double            value = polynomials.local_element(at);
              for (unsigned int c = 0; c < n_coefficients; ++c)
                value += polynomials.local_element(at + 1 + c) * terms[c];
              values[k] += weight * value;
            }
        }
    };
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (fitting.is_halved[i])
        {
          axes[i]                           = axes_of(fitting.cell[i]);
          to_unit[i]                        = invert(axes[i]);
          (*fitting.numbers[i])[has_halves] = 1.;
          add(i, i);
        }
    for (const auto &[i, j] : fitting.pairs)
      if (fitting.is_halved[i])
        add(i, j);
    for (LocalIndex i = 0; i < families.n_owned(); ++i)
      if (fitting.is_halved[i])
        for (unsigned int half = 0; half < n_halves; ++half)
          for (std::size_t k = 0; k < n_smooth; ++k)
            (*fitting.numbers[i])[first_half() + n_smooth * half + k] /= sum_of_weights[i][half];
  }

  PERIDEAL_INSTANTIATE_CLASS(CarriedState)
} // namespace perideal
