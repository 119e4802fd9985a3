// SPDX-License-Identifier: LGPL-2.1-or-later
#include <perideal/base/instantiate.h>
#include <perideal/operators/linear/bond_blocks.h>

namespace perideal
{
  template <int dim>
  BondBlocks<dim>::Ends::Ends(const typename GradientRows<dim>::Row &row)
    : column(row.column)
    , pattern(row.pattern)
    , numbers(row.value)
  {
    numbers.reserve((1 + dim * row.n_patterns) * size());
    for (unsigned int p = 0; p < row.n_patterns; ++p)
      for (unsigned int l = 0; l < dim; ++l)
        for (const dealii::Tensor<1, dim> &gradient : row.gradient[p])
          numbers.push_back(gradient[l]);
  }

  template <int dim>
  void BondBlocks<dim>::Ends::fill(const double                  pull,
                                   const double                  end,
                                   const dealii::Tensor<1, dim> &bond,
                                   const unsigned int            component,
                                   std::vector<double>          &result) const
  {
    const std::size_t n        = size();
    const double     *value    = numbers.data();
    const double     *gradient = value + (1 + dim * pattern[component]) * n;
    const auto        factor   = -0.5 * end * bond;
    result.resize(n);
    double *to = result.data();
    for (std::size_t k = 0; k < n; ++k)
      {
        double sum = pull * value[k];
        for (unsigned int l = 0; l < dim; ++l)
          sum += factor[l] * gradient[l * n + k];
        to[k] = sum;
      }
  }

  template <int dim>
  BondBlocks<dim>::BondBlocks(std::vector<dealii::Tensor<2, dim>> &blocks)
    : blocks(blocks)
    , place(blocks.size(), nowhere)
  {
  }

  template <int dim>
  void BondBlocks<dim>::start(const Ends &cell)
  {
    near = &cell;
    for (std::size_t k = 0; k < near->size(); ++k)
      place[near->column[k]] = k;
    for (auto &sum : sums)
      sum.assign(near->size(), 0.);
  }

  template <int dim>
  void BondBlocks<dim>::add_at(const LocalIndex column, const typename Symmetric::Pairs &block)
  {
    for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
      {
        const auto [a, b] = Symmetric::axes(p);
        blocks[column][a][b] += block[p];
        if (a != b)
          blocks[column][b][a] += block[p];
      }
  }

  template <int dim>
  unsigned int
  BondBlocks<dim>::fill(const BondDirections<dim> &directions, const bool has_tension, const Ends &far)
  {
    if (!has_tension && near->is_alike() && far.is_alike() && directions.are_at_rest())
      {
        near->fill(-1., 1., directions.bond, 0, of_bond[0]);
        far.fill(1., 1., directions.bond, 0, of_far[0]);
        return 1;
      }
    for (unsigned int a = 0; a < dim; ++a)
      {
        near->fill(-directions.pull[a], directions.near[a], directions.bond, a, of_bond[a]);
        far.fill(directions.pull[a], directions.far[a], directions.bond, a, of_far[a]);
      }
    if (has_tension)
      {
        near->fill(-1., 0., directions.bond, 0, of_bond[dim]);
        far.fill(1., 0., directions.bond, 0, of_far[dim]);
      }
    return has_tension ? dim + 1 : dim;
  }

  template <int dim>
  void BondBlocks<dim>::add(const BondDirections<dim> &directions,
                            const double               stiffness,
                            const double               tension,
                            const Ends                &far)
  {
    const unsigned int                     n_rows = fill(directions, tension != 0., far);
    std::array<double *, dim + 1>          here, there;
    const auto                             products = Symmetric::products(directions.bond);
    std::array<double, Symmetric::n_pairs> factor;
    for (unsigned int r = 0; r < n_rows; ++r)
      {
        here[r]  = of_bond[r].data();
        there[r] = of_far[r].data();
      }
    for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
      factor[p] = stiffness * (n_rows == 1 ? products[p] : 1.);
    const auto product = [&](const auto &rows, const unsigned int pair, const std::size_t k) {
      const auto [a, b] = Symmetric::axes(pair);
      if (n_rows == 1)
        return factor[pair] * rows[0][k] * rows[0][k];
      double result = factor[pair] * rows[a][k] * rows[b][k];
      if (a == b && n_rows > dim)
        result += tension * rows[dim][k] * rows[dim][k];
      return result;
    };
    for (std::size_t k = 0; k < far.size(); ++k)
      if (const LocalIndex at = place[far.column[k]]; at != nowhere)
        {
          for (unsigned int r = 0; r < n_rows; ++r)
            here[r][at] += there[r][k];
        }
      else
        {
          typename Symmetric::Pairs block;
          for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
            block[p] = product(there, p, k);
          add_at(far.column[k], block);
        }
    for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
      {
        double *sum = sums[p].data();
        for (std::size_t k = 0; k < near->size(); ++k)
          sum[k] += product(here, p, k);
      }
  }

  template <int dim>
  void BondBlocks<dim>::finish()
  {
    for (std::size_t k = 0; k < near->size(); ++k)
      {
        typename Symmetric::Pairs block;
        for (unsigned int p = 0; p < Symmetric::n_pairs; ++p)
          block[p] = sums[p][k];
        add_at(near->column[k], block);
        place[near->column[k]] = nowhere;
      }
  }

  PERIDEAL_INSTANTIATE_CLASS(BondBlocks)
} // namespace perideal
